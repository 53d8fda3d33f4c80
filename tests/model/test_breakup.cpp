// Break plans in whole particles: nothing is lost, nothing below the lower limit.

#include "model_testing.h"

#include "model/breakup.h"

using namespace ClusterDEM;

namespace {

void check(int n, int n_l, int lower)
{
  const BreakPlan plan = plan_breakup(n, n_l, lower);
  long sum = 0;
  int smallest = n, largest = 0;
  for (int piece = 0; piece < plan.pieces(); piece++) {
    const int particles = plan.particles(piece);
    sum += particles;
    smallest = std::min(smallest, particles);
    largest = std::max(largest, particles);
  }
  ASSERT_EQ(sum, n) << n_l << " " << lower;    // exact
  ASSERT_GE(plan.pieces(), 1) << n << " " << n_l << " " << lower;
  ASSERT_EQ(plan.largest(), largest) << n << " " << n_l << " " << lower;
  ASSERT_EQ(plan.is_event(), plan.pieces() > 1);
  if (n >= lower && n_l >= lower) { ASSERT_GE(smallest, lower) << n << " " << n_l << " " << lower; }
  // a folded remainder is the only way for a piece to exceed n_l, by less than the lower limit
  if (n_l > 0 && plan.is_event()) {
    ASSERT_LT(largest, n_l + std::max(lower, 1)) << n << " " << n_l << " " << lower;
    ASSERT_LE(n, largest + (plan.pieces() - 1) * static_cast<long>(n_l));
  }
}

}    // namespace

TEST(Breaks, BeyondTheHysteresisOnly)
{
  EXPECT_FALSE(breaks(1.0, 1.0, 0.0));    // d > l, not >=
  EXPECT_TRUE(breaks(1.0 + 1.0e-12, 1.0, 0.0));
  EXPECT_FALSE(breaks(1.25, 1.0, 0.26));
  EXPECT_TRUE(breaks(1.27, 1.0, 0.26));
  EXPECT_FALSE(breaks(0.5, 1.0, 0.26));
  // the hysteresis is relative to l
  EXPECT_TRUE(breaks(1.27e-4, 1.0e-4, 0.26));
  EXPECT_FALSE(breaks(1.27e4, 1.1e4, 0.26));
}

TEST(BreakPlan, ByHand)
{
  BreakPlan plan = plan_breakup(400, 75, 3);    // 5 x 75 + 25
  EXPECT_EQ(plan.pieces(), 6);
  EXPECT_EQ(plan.particles(0), 75);
  EXPECT_EQ(plan.particles(4), 75);
  EXPECT_EQ(plan.particles(5), 25);
  EXPECT_EQ(plan.largest(), 75);

  plan = plan_breakup(400, 100, 3);    // no remainder
  EXPECT_EQ(plan.pieces(), 4);
  EXPECT_EQ(plan.particles(3), 100);

  plan = plan_breakup(401, 100, 3);    // a remainder of 1 joins a sibling
  EXPECT_EQ(plan.pieces(), 4);
  EXPECT_EQ(plan.particles(2), 100);
  EXPECT_EQ(plan.particles(3), 101);
  EXPECT_EQ(plan.largest(), 101);

  plan = plan_breakup(403, 100, 3);    // a remainder of 3 stands alone
  EXPECT_EQ(plan.pieces(), 5);
  EXPECT_EQ(plan.particles(4), 3);
}

TEST(BreakPlan, OnePieceIsNoEvent)
{
  EXPECT_FALSE(plan_breakup(3, 3, 3).is_event());
  EXPECT_FALSE(plan_breakup(400, 400, 3).is_event());
  EXPECT_FALSE(plan_breakup(400, 2000, 3).is_event());
  EXPECT_FALSE(plan_breakup(4, 3, 3).is_event());    // 3 + 1 folds into 4
  EXPECT_FALSE(plan_breakup(5, 3, 3).is_event());
  EXPECT_TRUE(plan_breakup(6, 3, 3).is_event());
  EXPECT_FALSE(plan_breakup(102, 100, 3).is_event());
  EXPECT_TRUE(plan_breakup(103, 100, 3).is_event());
  EXPECT_EQ(plan_breakup(5, 3, 3).particles(0), 5);
}

TEST(BreakPlan, TheLargestBreakOfThePaper)
{
  const BreakPlan plan = plan_breakup(2000, 3, 3);    // 666 x 3 + 2: the 2 fold into the last
  EXPECT_EQ(plan.pieces(), 666);
  EXPECT_EQ(plan.particles(664), 3);
  EXPECT_EQ(plan.particles(665), 5);
}

TEST(BreakPlan, EveryPlanWithinThePapersLimits)
{
  for (int n = 3; n <= 2000; n += (n < 200 ? 1 : 7))
    for (int n_l = 3; n_l <= 2000; n_l += (n_l < 200 ? 1 : 13)) {
      check(n, n_l, 3);
      if (HasFatalFailure()) return;
    }
}

TEST(BreakPlan, AnyPlan)
{
  RandomInputs random(30);
  for (int k = 0; k < 20000; k++) {
    const int n = random.integer(1, random.coin() ? 100 : 20000);
    check(n, random.integer(0, random.coin() ? 20 : 20000), random.integer(0, 50));
    if (HasFatalFailure()) return;
  }
  // sums that would leave int if anything were added on the way
  for (int n_l : {1000000000, 2000000000, std::numeric_limits<int>::max() - 1})
    check(std::numeric_limits<int>::max(), n_l, 3);
}
