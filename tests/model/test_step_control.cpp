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

TEST(StepControl, ApproachAlongTheWay)
{
  // radii 2 and 1; the step of 0.5 led along x from (3, 0, 0.5) to (-1, 0, 0.5): nearest at (0, 0, 0.5)
  const Approach a = approach(2.0, 1.0, {-1.0, 0.0, 0.5}, {-8.0, 0.0, 0.0}, 0.5);
  EXPECT_DOUBLE_EQ(a.overlap, 2.5);
  EXPECT_DOUBLE_EQ(a.smaller, 2.0);
  EXPECT_DOUBLE_EQ(a.depth(), 1.25);
  EXPECT_DOUBLE_EQ(a.closing, 8.0 * 3.0 / std::sqrt(9.25));    // when it set out
  // now: 2.5 apart along y, which is an overlap of 0.5
  const Approach now = approach(2.0, 1.0, {0.0, 2.5, 0.0}, {7.0, -5.0, 0.0}, 0.0);
  EXPECT_DOUBLE_EQ(now.closing, 5.0);
  EXPECT_DOUBLE_EQ(now.time_to(0.75), 0.2);    // overlap 1.5
}

TEST(StepControl, MotionBetweenLooks)
{
  MotionBounds motion;
  motion.looked(3.0, 2.0, 10.0);
  EXPECT_EQ(motion.closing(), 3.0);
  EXPECT_DOUBLE_EQ(motion.closing_within(0.1), 4.0);
  EXPECT_DOUBLE_EQ(motion.approach_within(0.1), 0.4);
  EXPECT_DOUBLE_EQ(motion.way_within(0.1), 0.3);
  EXPECT_DOUBLE_EQ(motion.way_without_force(0.1), 0.2);
  EXPECT_DOUBLE_EQ(motion.with_contacts(5.0), 2.0 * 10.0 + 12.0 * 5.0);
  motion.pushed(30.0, 0.1);    // a mean of 20 for 0.1: each gained 2 at most, two of them 4
  EXPECT_DOUBLE_EQ(motion.closing(), 1.01 * 3.0 + 4.0);
  EXPECT_DOUBLE_EQ(motion.way_without_force(1.0), 1.01 * 2.0 + 2.0);
  motion.pushed(10.0, 0.1);
  EXPECT_DOUBLE_EQ(motion.closing(), 1.01 * 3.0 + 8.0);
  motion.looked(1.0, 1.0, 0.0);
  EXPECT_EQ(motion.closing_within(5.0), 1.0);
}

TEST(StepControl, DepthGrowsByTheApproach)
{
  EXPECT_DOUBLE_EQ(depth_after(0.2, 0.5, 2.0), 0.45);
  EXPECT_DOUBLE_EQ(depth_after(-1.0, 0.5, 2.0), 0.25);    // apart now: not known how far
  EXPECT_EQ(depth_after(INFINITY, 0.5, 2.0), INFINITY);
}

TEST(StepControl, PredictedStepKeepsPairsInSight)
{
  EXPECT_EQ(predicted_step(1.0, 0.5, 2.0, 0.0, INFINITY), 1.0);
  EXPECT_DOUBLE_EQ(predicted_step(1.0, 0.5, 2.0, 4.0, INFINITY), 0.125);    // 0.5 in 1/8 s: half of the limit
  EXPECT_DOUBLE_EQ(predicted_step(1.0, 0.5, 2.0, 4.0, 0.1), 0.09);
}

TEST(StepControl, DeepAndClosing)
{
  EXPECT_TRUE(deep_and_closing(0.6, 0.1, 1.0));
  EXPECT_FALSE(deep_and_closing(0.4, 0.1, 1.0));
  EXPECT_FALSE(deep_and_closing(0.6, -0.1, 1.0));
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
