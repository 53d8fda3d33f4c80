// The step: bounds, halving, growth, what is judged.

#include "model/step_control.h"

#include <gtest/gtest.h>

using namespace ClusterDEM;

TEST(StepControl, PublishedContactBound)
{
  // MODEL section 6: 1.1e-5 s for the smallest cluster, 3 particles, k_n = 10 N/m
  const double m = 3.0 * 3.14159265358979323846 / 6.0 * 1.0e-12 * 2000.0;
  EXPECT_NEAR(contact_step(3.14159265358979323846 / 5.0, m, 10.0), 1.1e-5, 5.0e-7);
}

TEST(StepControl, TimeToOverlap)
{
  EXPECT_DOUBLE_EQ(time_to_overlap(-1.0, 1.0, 4.0), 0.5);
  EXPECT_EQ(time_to_overlap(2.0, 1.0, 4.0), 0.0);
  EXPECT_EQ(time_to_overlap(0.0, 1.0, 0.0), INFINITY);
  EXPECT_EQ(time_to_overlap(0.0, 1.0, -1.0), INFINITY);
}

TEST(StepControl, PassageFindsTheNearestPoint)
{
  EXPECT_DOUBLE_EQ(passage({1.0, 0.0, 0.5}, {-4.0, 0.0, 0.0}, 10.0).closest, 0.5);     // on the way
  EXPECT_DOUBLE_EQ(passage({1.0, 0.0, 0.0}, {-4.0, 0.0, 0.0}, 10.0).closest, 0.0);     // through the centre
  EXPECT_DOUBLE_EQ(passage({1.0, 0.0, 0.0}, {-4.0, 0.0, 0.0}, 0.125).closest, 0.5);    // at its end
  EXPECT_DOUBLE_EQ(passage({1.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, 10.0).closest, 1.0);      // at its start
  EXPECT_DOUBLE_EQ(passage({1.0, 0.0, 0.0}, {-4.0, 3.0, 0.0}, 0.0).closing, 4.0);
  EXPECT_DOUBLE_EQ(passage({2.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1.0).closest, 2.0);
  EXPECT_DOUBLE_EQ(passage({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0).closing, 0.0);
}

TEST(StepControl, OnlyCreatedEnergyCounts)
{
  EXPECT_EQ(relative_creation(-1.0, 2.0), 0.0);
  EXPECT_EQ(relative_creation(0.0, 0.0), 0.0);
  EXPECT_EQ(relative_creation(1.0, 2.0), 0.5);
  EXPECT_EQ(relative_creation(1.0, 0.0), INFINITY);
}

static StepSize step_of(double most, double floor, int retries)
{
  StepSize step;
  step.most = most;
  step.floor = floor;
  step.retries = retries;
  step.start(most);
  return step;
}

TEST(StepControl, HalvesDownToTheFloor)
{
  StepSize step = step_of(1.0, 0.2, 10);
  EXPECT_TRUE(step.halve());
  EXPECT_EQ(step.now(), 0.5);
  EXPECT_TRUE(step.halve());
  EXPECT_TRUE(step.halve());
  EXPECT_EQ(step.now(), 0.2);
  EXPECT_FALSE(step.halve());
}

TEST(StepControl, RetriesAreCountedInARow)
{
  StepSize step = step_of(1.0, 0.0, 2);
  EXPECT_TRUE(step.halve());
  EXPECT_TRUE(step.halve());
  EXPECT_FALSE(step.halve());
  step.accept(0.0);
  EXPECT_TRUE(step.halve());
}

TEST(StepControl, GrowsBackAfterQuietStepsAlone)
{
  StepSize step = step_of(1.0, 0.0, 10);
  step.halve();
  for (int k = 0; k < 9; k++) step.accept(0.0);
  EXPECT_EQ(step.now(), 0.5);
  step.accept(0.9);    // near what would be too much: not quiet
  for (int k = 0; k < 9; k++) step.accept(0.0);
  EXPECT_EQ(step.now(), 0.5);
  step.accept(0.0);
  EXPECT_EQ(step.now(), 1.0);
  for (int k = 0; k < 50; k++) step.accept(0.0);
  EXPECT_EQ(step.now(), 1.0);
}

TEST(StepControl, CautiousStepsAreShorter)
{
  const StepSize step = step_of(1.0, 0.01, 10);
  EXPECT_EQ(step.cautious(1.0, 0.1), 1.0);
  EXPECT_DOUBLE_EQ(step.cautious(1.0, 0.5), 0.5);
  EXPECT_EQ(step.cautious(1.0, 1.0e9), 0.01);
}
