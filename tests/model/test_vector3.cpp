// Vectors: the handful of operations.

#include "model_testing.h"

using namespace ClusterDEM;

TEST(Vector3, Operations)
{
  const Vec3 a = {1.0, -2.0, 3.0}, b = {4.0, 5.0, -6.0};
  EXPECT_EQ(a + b, (Vec3{5.0, 3.0, -3.0}));
  EXPECT_EQ(a - b, (Vec3{-3.0, -7.0, 9.0}));
  EXPECT_EQ(2.0 * a, (Vec3{2.0, -4.0, 6.0}));
  EXPECT_EQ(dot(a, b), 4.0 - 10.0 - 18.0);
  const double raw[] = {1.0, 2.0, 3.0};
  EXPECT_EQ(to_vec3(raw), (Vec3{1.0, 2.0, 3.0}));
}

TEST(Vector3, NormOfKnownTriples)
{
  // Pythagorean quadruples; a sum of squares and a root: within 2 units in the last place
  EXPECT_TRUE(relatively_near(norm({1.0, 2.0, -2.0}), 3.0, 2.0 * EPS));
  EXPECT_TRUE(relatively_near(norm({-2.0, 3.0, 6.0}), 7.0, 2.0 * EPS));
  EXPECT_EQ(norm({0.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(norm({0.0, -5.0, 0.0}), 5.0);
}

TEST(Vector3, NormOverTheRangeWhoseSquaresAreNumbers)
{
  // beyond 1e154 and below 1e-154 the squares leave the range of double; no length or speed does
  EXPECT_TRUE(relatively_near(norm({1.0e150, 2.0e150, 2.0e150}), 3.0e150, 4.0 * EPS));
  EXPECT_TRUE(relatively_near(norm({1.0e-150, 2.0e-150, 2.0e-150}), 3.0e-150, 4.0 * EPS));
}

TEST(Vector3, NormIsEvenToTheBit)
{
  // what lets both sides of a pair compute |V_i - V_j| alike
  RandomInputs random(101);
  for (int k = 0; k < 10000; k++) {
    const Vec3 a = random.vector(1.0e3), b = random.vector(1.0e3);
    ASSERT_EQ(norm(a - b), norm(b - a));
  }
}
