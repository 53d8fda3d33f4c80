// Walls, kinds of clusters and small formulas of the adapters: by hand.

#include "model_testing.h"

#include "model/cluster_kinds.h"
#include "model/contact_law.h"
#include "model/decisive_terms.h"
#include "model/merging.h"
#include "model/placement.h"
#include "model/wall_shapes.h"

using namespace ClusterDEM;

TEST(WallShapes, ASphereStaysOnItsParentsSideOfAPlane)
{
  for (int axis = 0; axis < 3; axis++) {
    Vec3 parent = {0.0, 0.0, 0.0}, near = parent, far = parent, across = parent;
    parent[axis] = 3.0;
    near[axis] = 2.5;
    far[axis] = 2.25;
    across[axis] = 1.0;
    EXPECT_TRUE(beside_plane(axis, 2.0, parent, near, 0.5));
    EXPECT_FALSE(beside_plane(axis, 2.0, parent, far, 0.5));
    EXPECT_FALSE(beside_plane(axis, 2.0, parent, across, 0.5));    // clear of the plane, behind it
    EXPECT_TRUE(beside_plane(axis, 2.0, across, across, 0.5));     // whose parent is there as well
    EXPECT_FALSE(beside_plane(axis, 2.0, across, parent, 0.5));
    across[axis] = 1.75;    // in the plane from below
    EXPECT_FALSE(beside_plane(axis, 2.0, across, across, 0.5));
  }
}

TEST(WallShapes, ASphereStaysOnItsParentsSideOfACylinder)
{
  const Vec3 middle = {10.0, 20.0, 30.0};
  for (int axis = 0; axis < 3; axis++) {
    auto at = [&](double distance, double along) {
      Vec3 x = middle;
      x[(axis + 1) % 3] += 0.6 * distance;
      x[(axis + 2) % 3] -= 0.8 * distance;
      x[axis] += along;
      return x;
    };
    EXPECT_TRUE(beside_cylinder(axis, middle, 5.0, at(0.0, 0.0), at(3.9, 100.0), 1.0));
    EXPECT_FALSE(beside_cylinder(axis, middle, 5.0, at(0.0, 0.0), at(4.1, 100.0), 1.0));
    EXPECT_FALSE(beside_cylinder(axis, middle, 5.0, at(0.0, 0.0), at(7.0, 0.0), 1.0));
    EXPECT_TRUE(beside_cylinder(axis, middle, 5.0, at(7.0, 0.0), at(6.1, -50.0), 1.0));
    EXPECT_FALSE(beside_cylinder(axis, middle, 5.0, at(7.0, 0.0), at(5.9, -50.0), 1.0));
    EXPECT_FALSE(beside_cylinder(axis, middle, 5.0, at(7.0, 0.0), at(1.0, 0.0), 1.0));
  }
}

TEST(ClusterKinds, TypesWithoutAKindHaveTheFirst)
{
  ClusterKinds kinds(3);
  kinds.kind(0) = {1.0e-4, 2000.0};
  kinds.limits = {4, 500};
  kinds.add(2, {3.0e-4, 1000.0});
  kinds.set_voidage(0.75);
  EXPECT_EQ(kinds.count(), 2);
  EXPECT_EQ(kinds.of_type(1), 0);
  EXPECT_EQ(kinds.of_type(2), 1);
  EXPECT_EQ(kinds.of_type(3), 0);
  EXPECT_EQ(kinds.geometry(2).rho_p, 1000.0);
  EXPECT_EQ(kinds.geometry(2).voidage, 0.75);
  EXPECT_NEAR(kinds.largest_diameter(), 3.0e-4 * std::cbrt(2000.0), 1e-18);    // 500/(1 - 0.75)
  EXPECT_NEAR(kinds.smallest_diameter(), 1.0e-4 * std::cbrt(16.0), 1e-18);
}

TEST(SmallFormulas, ByHand)
{
  EXPECT_DOUBLE_EQ(secant_stiffness(5.0e-8, 1.0e-4), 10.0);    // 1/2 10 N/m (100 um)^2
  EXPECT_DOUBLE_EQ(sphere_density(PI / 6.0 * 8.0, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(mass_mean(60.0, 400.0, 100.0, 300.0), 337.5);
  EXPECT_DOUBLE_EQ(mean_speed(18.0, 4.0), 4.5);
  EXPECT_DOUBLE_EQ(superficial_speed(4.5, 4.0, 2000.0, 0.5), 0.018);
  EXPECT_DOUBLE_EQ(room_of_halves(2.0, 2.0), 3.0 / std::cbrt(2.0));
  EXPECT_DOUBLE_EQ(PowerParts(2.0, 0.5, 0.7).e_in(), 1.8);
  EXPECT_DOUBLE_EQ((Spinning{5.0, 2.0, {3.0, 0.0, 4.0}}).energy(), 0.5 * 8.0 * 25.0);    // I = 0.4 5 4
}

TEST(SizeRule, BreakupIsAPlanOrNone)
{
  const SizeRule rule{1.0, 0.26, {1.0e-4, 2000.0}, {3, 2000}};
  const double d = rule.geometry.diameter(400);
  const BreakPlan plan = rule.breakup(400, d, {d / 1.3, 150});
  EXPECT_EQ(plan.whole, 2);
  EXPECT_EQ(plan.last, 100);
  EXPECT_FALSE(rule.breakup(400, d, {d / 1.25, 150}).is_event());    // within the hysteresis
  EXPECT_FALSE(rule.breakup(400, d, {d / 1.3, 400}).is_event());     // not above the stable number
  EXPECT_FALSE(
      rule.breakup(4, rule.geometry.diameter(4), {1.0e-6, 3}).is_event());    // a crumb of one goes to its sibling
}
