// Where two spheres touch, and how they slip there.

#include "model/touch.h"

#include <gtest/gtest.h>

using namespace ClusterDEM;

TEST(Touch, NormalAndTangentialVelocity)
{
  // centres 5 apart along (3, 0, 4); radii 2 and 3.5
  const Touch t = touch_of(2.0, 3.5, {3.0, 0.0, 4.0}, {1.0, 2.0, 1.0});
  EXPECT_DOUBLE_EQ(t.r, 5.0);
  EXPECT_DOUBLE_EQ(t.overlap, 0.5);
  EXPECT_DOUBLE_EQ(t.n[0], 0.6);
  EXPECT_DOUBLE_EQ(t.n[2], 0.8);
  EXPECT_DOUBLE_EQ(t.v_n, 1.4);
  EXPECT_NEAR(dot(t.slip, t.n), 0.0, 1.0e-15);
  EXPECT_NEAR(t.slip[1], 2.0, 1.0e-15);
  EXPECT_DOUBLE_EQ(norm(t.slip), std::sqrt(6.0 - 1.4 * 1.4));
}

TEST(Touch, RollingSpheresDoNotSlip)
{
  // i above j, both touching planes that are half of the overlap below their surfaces; they turn like two gears
  const double a = 2.0, b = 3.5, overlap = 0.5;
  const double arm_a = contact_arm(a, overlap), arm_b = contact_arm(b, overlap);
  EXPECT_DOUBLE_EQ(arm_a, 1.75);
  const Touch t = touch_of(a, b, {0.0, 0.0, a + b - overlap}, {0.0, 0.0, 0.0});
  const Touch gears = turning(t, a, {0.0, 4.0 / arm_a, 0.0}, b, {0.0, -4.0 / arm_b, 0.0});
  EXPECT_NEAR(norm(gears.slip), 0.0, 1.0e-15);
  // a spinning about y: its lowest point moves along -x
  const Touch one = turning(t, a, {0.0, 4.0 / arm_a, 0.0}, b, {0.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(one.slip[0], -4.0);
  EXPECT_DOUBLE_EQ(one.v_n, 0.0);
}
