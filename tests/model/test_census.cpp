// Totals: each by hand.

#include "model_testing.h"

#include "census.h"

using namespace ClusterDEM;
using LAMMPS_NS::Census;
using LAMMPS_NS::Event;

namespace {

// a rule under which E_in* = 1 W/kg is the power at which 400 particles just break: l = K/E, h = 0.26
const double d400 = ClusterGeometry{1.0e-4, 2000.0}.diameter(400);
const SizeRule rule{d400 / 1.26, 0.26, {1.0e-4, 2000.0}, {3, 2000}};

double of(const Census &census, Census::Total what)
{
  return census.totals()[what];
}

}    // namespace

TEST(Census, EventsThatHappen)
{
  Census census;
  Event breakup, merge, refused;
  breakup.plan = {3, 100, 40};
  merge.j = 5;
  merge.plan = {1, 300, 0};
  merge.energy_lost = 2.0;
  merge.energy_born = 0.25;
  refused.j = 7;
  refused.plan = {2, 80, 40};
  refused.energy_lost = 1.0;
  for (const Event &e : {breakup, merge, refused}) census.happened(e);
  EXPECT_EQ(of(census, Census::BREAKUPS), 2);
  EXPECT_EQ(of(census, Census::MERGES), 2);
  EXPECT_EQ(of(census, Census::BORN), 4 + 3);
  EXPECT_EQ(of(census, Census::E_LOST), 3.0);
  EXPECT_EQ(of(census, Census::E_BORN), 0.25);
}

TEST(Census, WhatDecidedABreakup)
{
  Census census;
  census.broke(rule, {2.0, 0.5, 0.5}, 400,
               d400);    // 2 W/kg: without N_st 0, it would not; without N_cc 1.5, it would
  EXPECT_NEAR(of(census, Census::SHARE_ST), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(of(census, Census::SHARE_CC), 0.5 / 3.0, 1e-15);
  EXPECT_NEAR(of(census, Census::SHARE_MF), 0.5 / 3.0, 1e-15);
  EXPECT_EQ(of(census, Census::BREAKUPS_BY_ST), 1);
  EXPECT_EQ(of(census, Census::BREAKUPS_BY_CC), 0);
  census.broke(rule, {0.9, 0.6, 0.1}, 400, d400);    // without either it would not
  EXPECT_EQ(of(census, Census::BREAKUPS_BY_ST), 2);
  EXPECT_EQ(of(census, Census::BREAKUPS_BY_CC), 1);
}

TEST(Census, WhatKeptAClusterWhole)
{
  Census census;
  census.whole(rule, {2.0, 0.0, 1.5}, 400, d400);     // 0.5 W/kg: without N_smf 2
  census.whole(rule, {-1.0, 1.6, 0.0}, 400, d400);    // 0.6: without N_st 1.6
  census.whole(rule, {0.2, 0.0, 0.1}, 400, d400);     // with neither term left out
  EXPECT_EQ(of(census, Census::WHOLE_BY_MF), 1);
  EXPECT_EQ(of(census, Census::WHOLE_BY_ST), 1);
}

TEST(Census, WhatDecidedAMergeCountsOnceForBoth)
{
  Census census;
  const PowerParts calm(0.1, 0.0, 0.0), held(2.0, 0.0, 1.9), braked(-1.9, 2.0, 0.0);
  census.merged(rule, held, held, 400);
  EXPECT_EQ(of(census, Census::MERGES_BY_MF), 1);
  census.merged(rule, calm, held, 400);
  EXPECT_EQ(of(census, Census::MERGES_BY_MF), 2);
  census.merged(rule, braked, calm, 400);
  EXPECT_EQ(of(census, Census::MERGES_BY_ST), 1);
  census.merged(rule, calm, calm, 400);
  EXPECT_EQ(of(census, Census::MERGES_BY_MF), 2);
  EXPECT_EQ(of(census, Census::MERGES_BY_ST), 1);
}

TEST(Census, WhoComesAndGoes)
{
  Census census;
  census.came(400);
  census.came(60);
  census.left(400);
  census.left(30);
  census.left_elsewhere(30);    // it went to another rank only
  EXPECT_EQ(of(census, Census::FED), 460);
  EXPECT_EQ(of(census, Census::CLUSTERS_FED), 2);
  EXPECT_EQ(of(census, Census::LEFT), 400);
  EXPECT_EQ(of(census, Census::CLUSTERS_LEFT), 1);
}
