// Which terms decide: by hand on single clusters, and against the verdicts themselves on random ones.

#include "model_testing.h"

#include "model/decisive_terms.h"

using namespace ClusterDEM;

namespace {
const SizeLimits limits;
constexpr double K = 0.0266;
const SizeRule rule{K, 0.26, paper_geometry, limits};
const int n = 400;
const double d = paper_geometry.diameter(n);
// 400 particles break where l < d/1.26: they are two whole stable clusters then
const double threshold = 1.26 * K / d;
}    // namespace

TEST(PowerParts, SharesAndSums)
{
  const PowerParts power(-3.0, 1.0, 4.0);
  EXPECT_DOUBLE_EQ(power.share(PowerParts::ST), 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(power.share(PowerParts::CC), 1.0 / 8.0);
  EXPECT_DOUBLE_EQ(power.share(PowerParts::MF), 0.5);
  EXPECT_DOUBLE_EQ(power.e_in_without(PowerParts::ST), -3.0);
  EXPECT_DOUBLE_EQ(power.e_in_without(PowerParts::CC), -7.0);
  EXPECT_DOUBLE_EQ(power.e_in_without(PowerParts::MF), -2.0);
  EXPECT_DOUBLE_EQ(power.e_in_without(PowerParts::NTERMS), -6.0);    // all of E_in*
  EXPECT_EQ(PowerParts(0.0, 0.0, 0.0).share(PowerParts::ST), 0.0);
}

TEST(DecisiveTerms, OfABreakupOnlyWhatDrives)
{
  // E_in* = 1.1 of the threshold; without N_st 0.3, without N_cc 0.7 of it: both were needed
  const PowerParts both(0.8 * threshold, 0.4 * threshold, 0.1 * threshold);
  EXPECT_TRUE(rule.breaks(n, d, both.e_in_without(PowerParts::NTERMS)));
  EXPECT_TRUE(rule.breaks_only_by(PowerParts::ST, both, n, d));
  EXPECT_TRUE(rule.breaks_only_by(PowerParts::CC, both, n, d));
  EXPECT_FALSE(rule.breaks_only_by(PowerParts::MF, both, n, d));
  // N_st is enough
  const PowerParts gas(1.3 * threshold, 0.4 * threshold, 0.1 * threshold);
  EXPECT_TRUE(rule.breaks_only_by(PowerParts::ST, gas, n, d));
  EXPECT_FALSE(rule.breaks_only_by(PowerParts::CC, gas, n, d));
  // a term that is 0 decides nothing
  EXPECT_FALSE(rule.breaks_only_by(PowerParts::CC, PowerParts(1.1 * threshold, 0.0, 0.0), n, d));
}

TEST(DecisiveTerms, WhatKeepsAClusterWhole)
{
  const PowerParts held(1.1 * threshold, 0.0, 0.2 * threshold);
  EXPECT_TRUE(rule.whole_only_by(PowerParts::MF, held, n, d));
  EXPECT_FALSE(rule.whole_only_by(PowerParts::ST, held, n, d));    // it drives
  // the gas slows this one down: N_st < 0
  const PowerParts slowed(-0.3 * threshold, 1.2 * threshold, 0.0);
  EXPECT_TRUE(rule.whole_only_by(PowerParts::ST, slowed, n, d));
  // N_smf or not, this one does not break
  EXPECT_FALSE(rule.whole_only_by(PowerParts::MF, PowerParts(0.9 * threshold, 0.0, 0.2 * threshold), n, d));
}

TEST(DecisiveTerms, OfAMerge)
{
  // stable without N_smf: l = d, 400 particles; with it any size
  const PowerParts power(K / d, 0.0, 2.0 * K / d);
  EXPECT_FALSE(rule.merges_only_by(PowerParts::MF, power, 400));
  EXPECT_TRUE(rule.merges_only_by(PowerParts::MF, power, 401));
  EXPECT_FALSE(rule.merges_only_by(PowerParts::ST, power, 401));
  EXPECT_TRUE(rule.merges_only_by(PowerParts::ST, PowerParts(-2.0 * K / d, K / d, 0.0), 401));
}

// The shortcut before the cube root changes no verdict: Eq. (1) and the plan in full
TEST(DecisiveTerms, SameVerdictAsTheCheckItself)
{
  RandomInputs random(31);
  int broke = 0;
  for (int trial = 0; trial < 200000; trial++) {
    const int m = random.integer(limits.lo, limits.hi);
    const double size = paper_geometry.diameter(m);
    const double e_in = random.uniform(-0.5, 6.0) * K / size;
    const StableSize stable = stable_size(K, e_in, paper_geometry, limits);
    const bool verdict =
        m > stable.n && breaks(size, stable.l, 0.26) && plan_breakup(m, stable.n, limits.lo).is_event();
    ASSERT_EQ(rule.breaks(m, size, e_in), verdict) << m << " particles, E_in* " << e_in;
    broke += verdict;
  }
  EXPECT_GT(broke, 50000);
  EXPECT_LT(broke, 190000);
}
