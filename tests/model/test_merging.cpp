// Merging: a criterion that both sides agree on, and a merge that conserves.

#include "model_testing.h"

#include "model/merging.h"

using namespace ClusterDEM;

namespace {

Body random_body(RandomInputs &random)
{
  // clusters of 3 to 2000 particles of 1 um to 5 mm, in a box of metres, at up to 300 m/s
  const ClusterGeometry g = random.geometry();
  return {g.mass(random.integer(3, 2000)), random.vector(10.0), random.vector(300.0)};
}

long double kinetic(const Body &b)
{
  long double v2 = 0.0L;
  for (double v : b.v) v2 += static_cast<long double>(v) * v;
  return 0.5L * b.mass * v2;
}

}    // namespace

TEST(RelativeSlip, ByHand)
{
  EXPECT_DOUBLE_EQ(relative_slip({0.0, 0.0, 2.0}, {0.0, 0.0, 2.01}),
                   (2.01 - 2.0) / 2.0);    // the slower divides
  EXPECT_DOUBLE_EQ(relative_slip({0.0, 0.0, 2.0}, {0.0, 0.0, -2.0}), 2.0);
  EXPECT_DOUBLE_EQ(relative_slip({3.0, 0.0, 0.0}, {0.0, 0.0, 4.0}), 5.0 / 3.0);
}

TEST(RelativeSlip, AtRest)
{
  // two at rest move alike; one at rest and one moving never do
  EXPECT_EQ(relative_slip({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(relative_slip({1.0, -2.0, 3.0}, {1.0, -2.0, 3.0}), 0.0);
  EXPECT_TRUE(std::isinf(relative_slip({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0e-150})));
  EXPECT_TRUE(std::isinf(relative_slip({0.0, 5.0, 0.0}, {0.0, 0.0, 0.0})));
}

TEST(RelativeSlip, SymmetricToTheBit)
{
  RandomInputs random(50);
  for (int k = 0; k < 50000; k++) {
    const Vec3 a = random.vector(300.0), c = random.vector(300.0);
    const Vec3 near = a + random.log_uniform(1.0e-16, 1.0e-2) * c;    // around the tolerance, too
    for (const Vec3 &b : {c, near, a}) {
      const double slip = relative_slip(a, b);
      ASSERT_EQ(slip, relative_slip(b, a));
      ASSERT_FALSE(std::isnan(slip));
      ASSERT_GE(slip, 0.0);
      if (std::isinf(slip)) continue;    // one of them at rest
      // never below the paper's own |dV|/|V_i|, for either i; a quotient rounds once
      ASSERT_GE(slip * norm(a) * (1.0 + 2.0 * EPS), norm(a - b));
      ASSERT_GE(slip * norm(b) * (1.0 + 2.0 * EPS), norm(a - b));
    }
  }
}

TEST(RelativeSlip, ExtremeVelocities)
{
  RandomInputs random(51);
  for (int k = 0; k < 10000; k++) {
    const double scale = random.log_uniform(1.0e-140, 1.0e140);    // squares stay numbers
    const Vec3 a = scale * random.vector(1.0), b = random.vector(1.0e140);
    const double slip = relative_slip(a, b);
    ASSERT_FALSE(std::isnan(slip));
    ASSERT_EQ(slip, relative_slip(b, a));
  }
}

TEST(FitsTogether, UpToTheStableSize)
{
  EXPECT_TRUE(fits_together(1000, 1000, 2000));    // the largest can be reached
  EXPECT_FALSE(fits_together(1000, 1001, 2000));
  EXPECT_TRUE(fits_together(3, 3, 6));
  EXPECT_FALSE(fits_together(3, 3, 5));
  EXPECT_FALSE(fits_together(2000000000, 2000000000, 2000));    // a sum would leave int
}

TEST(Combine, ByHand)
{
  const Body c = combine({1.0, {0.0, 0.0, 0.0}, {4.0, 0.0, -8.0}}, {3.0, {4.0, 8.0, -4.0}, {0.0, 4.0, 0.0}});
  EXPECT_EQ(c.mass, 4.0);
  EXPECT_EQ(c.x, (Vec3{3.0, 6.0, -3.0}));
  EXPECT_EQ(c.v, (Vec3{1.0, 3.0, -2.0}));
}

TEST(Combine, ConservesMassMomentumAndCentreOfMass)
{
  RandomInputs random(52);
  for (int k = 0; k < 50000; k++) {
    const Body a = random_body(random), b = random_body(random);
    const Body c = combine(a, b);
    ASSERT_TRUE(finite(c.x) && finite(c.v));
    ASSERT_EQ(c.mass, a.mass + b.mass);    // the one rounding of the sum
    for (int q = 0; q < 3; q++) {
      // each sum has five roundings of terms no larger than these
      const double momentum = a.mass * std::fabs(a.v[q]) + b.mass * std::fabs(b.v[q]);
      const double moment = c.mass * (std::fabs(a.x[q]) + std::fabs(b.x[q]));
      ASSERT_NEAR(c.mass * c.v[q], a.mass * a.v[q] + b.mass * b.v[q], 6.0 * EPS * momentum);
      ASSERT_NEAR(c.mass * c.x[q], a.mass * a.x[q] + b.mass * b.x[q], 6.0 * EPS * moment);
    }
  }
}

TEST(Combine, WholeParticlesAddUp)
{
  // the mass of a merged cluster counts as the sum of the counts, within the 1e-6 of count_from_mass
  RandomInputs random(53);
  for (int k = 0; k < 10000; k++) {
    const ClusterGeometry g = random.geometry();
    const int n = random.integer(3, 1000), m = random.integer(3, 1000);
    const auto count = g.count_from_mass(combine({g.mass(n), {}, {}}, {g.mass(m), {}, {}}).mass);
    ASSERT_TRUE(count.whole);
    ASSERT_EQ(count.n, n + m);
  }
}

TEST(EnergyLost, ByHand)
{
  // equal masses meeting head on: all of it, 2 x 1/2 x 2 kg x (3 m/s)^2 = 18 J
  EXPECT_DOUBLE_EQ(energy_lost({2.0, {}, {0.0, 0.0, 3.0}}, {2.0, {}, {0.0, 0.0, -3.0}}), 18.0);
  EXPECT_EQ(energy_lost({2.0, {}, {1.0, 2.0, 3.0}}, {5.0, {}, {1.0, 2.0, 3.0}}), 0.0);    // moving alike: none
}

TEST(EnergyLost, EqualsTheKineticDifference)
{
  RandomInputs random(54);
  for (int k = 0; k < 50000; k++) {
    const Body a = random_body(random), b = random_body(random);
    const double lost = energy_lost(a, b);
    ASSERT_GE(lost, 0.0);
    ASSERT_EQ(lost, energy_lost(b, a));
    const long double before = kinetic(a) + kinetic(b);
    const long double after = kinetic(combine(a, b));
    // the velocity of the merged body is rounded some four times, which counts twice in its energy
    ASSERT_LE(std::fabs(static_cast<double>(before - after - lost)), 16.0 * EPS * static_cast<double>(before));
  }
}

TEST(BirthEnergy, WhatIsLessIsNotCredited)
{
  EXPECT_DOUBLE_EQ(birth_energy(5.0, 3.0), 2.0);
  EXPECT_EQ(birth_energy(3.0, 5.0), 0.0);
  EXPECT_DOUBLE_EQ(birth_energy(2.0, -1.0), 3.0);    // cohesion held energy back
}

TEST(BirthEnergy, AMillionthOfTheKineticEnergyIsNegligible)
{
  const Body body{4.0, {}, {0.0, 3.0, 4.0}};    // 50
  EXPECT_TRUE(negligible_birth(49.9e-6, body));
  EXPECT_FALSE(negligible_birth(50.1e-6, body));
  EXPECT_TRUE(negligible_birth(0.0, {4.0, {}, {}}));    // at rest nothing may be put in, and nothing is
}

TEST(MergedSpin, KeepsTheSpinAndAddsNoEnergy)
{
  RandomInputs random(51);
  for (int k = 0; k < 20000; k++) {
    const ClusterGeometry g = random.geometry();
    const int n[2] = {random.integer(3, 2000), random.integer(3, 2000)};
    Spinning s[2];
    for (int m = 0; m < 2; m++) s[m] = {g.mass(n[m]), 0.5 * g.diameter(n[m]), random.vector(1.0e4)};
    if (k % 2) s[1].omega = s[0].omega;    // where a mean of the velocities adds most, 59 % for equal clusters
    const Spinning merged{s[0].mass + s[1].mass, 0.5 * g.diameter(n[0] + n[1]),
                          merged_spin(s[0], s[1], 0.5 * g.diameter(n[0] + n[1]))};
    double before = 0.0, scale = 0.0;
    for (const Spinning &one : s) {
      before += 0.5 * one.inertia() * dot(one.omega, one.omega);
      scale += one.inertia() * norm(one.omega);
    }
    for (int axis = 0; axis < 3; axis++)
      ASSERT_NEAR(merged.inertia() * merged.omega[axis],
                  s[0].inertia() * s[0].omega[axis] + s[1].inertia() * s[1].omega[axis], 8.0 * EPS * scale);
    ASSERT_LE(0.5 * merged.inertia() * dot(merged.omega, merged.omega), before * (1.0 + 8.0 * EPS));
  }
}
