// Energy that contacts create in a step.

#include "model/step_energy.h"

#include <gtest/gtest.h>

using namespace ClusterDEM;

TEST(StepEnergy, OnlyCreatedEnergyCounts)
{
  EXPECT_EQ(relative_creation(-1.0, 2.0), 0.0);
  EXPECT_EQ(relative_creation(0.0, 0.0), 0.0);
  EXPECT_EQ(relative_creation(1.0, 2.0), 0.5);
  EXPECT_EQ(relative_creation(1.0, 0.0), INFINITY);
}

TEST(StepEnergy, KineticEnergy)
{
  const double v[3] = {1.0, -2.0, 3.0};
  EXPECT_DOUBLE_EQ(twice_kinetic_energy(0.5, v), 7.0);
}

// One step of velocity Verlet with a force at each end: the work of both is the gain of kinetic energy, exactly.
TEST(StepEnergy, WorkIsTheGainOfVelocityVerlet)
{
  const double m = 0.3, dt = 0.7;
  const Vec3 v{1.0, -2.0, 0.5}, first{0.4, 0.1, -0.9}, second{-1.3, 0.2, 0.6};
  const Vec3 half = v + (0.5 * dt / m) * first, end = half + (0.5 * dt / m) * second;
  const double gain = 0.5 * (twice_kinetic_energy(m, end.data()) - twice_kinetic_energy(m, v.data()));
  EXPECT_NEAR(contact_work(dt, quarter_work(first, v, end) + quarter_work(second, v, end)), gain, 1.0e-14);
}

TEST(StepEnergy, VelocityAtTheStartOfAStep)
{
  const double m = 0.25, dt = 0.5, ftm2v = 3.0;
  const Vec3 v{1.0, 2.0, -1.0}, gravity{0.0, 0.5, -2.0};
  const Vec3 half = v + (0.5 * dt * ftm2v / m) * gravity;
  const Vec3 back = velocity_at_start(half, gravity, m, dt, ftm2v);
  for (int k = 0; k < 3; k++) EXPECT_DOUBLE_EQ(back[k], v[k]);
}

TEST(StepEnergy, RecentErrorIsForgottenByAFifthPerStep)
{
  EXPECT_EQ(recent_error(0.5, 0.7), 0.7);
  EXPECT_DOUBLE_EQ(recent_error(0.5, 0.1), 0.4);
}

TEST(StepEnergy, RestlessnessSumsOverContacts)
{
  Restlessness r;
  r.add_swing(1.0, 10.0, 4.0, 3.0, 2.0);    // 10 (2 + 1.5)
  r.add_swing(0.5, 10.0, 4.0, 3.0, 2.0);
  r.add_creep(0.5, 6.0, 4.0, 0.1);    // 0.5 * 6 * 2 / 0.1
  r.add_force(6.0, 3.0, 2.0);
  r.add_force(1.0, 3.0, 2.0);
  EXPECT_DOUBLE_EQ(r.swing, 52.5);
  EXPECT_DOUBLE_EQ(r.creep, 60.0);
  EXPECT_DOUBLE_EQ(r.strongest, 3.0);
}

// A head-on elastic contact of two equal spheres by velocity Verlet, begun anywhere within a step: what a step creates
// stays below what is possible, and is not ten thousand times less (the bound has a share for ten more contacts).
TEST(StepEnergy, PossibleCreationBoundsTheLinearSpring)
{
  const double mass = 2.0, k_n = 50.0, speed = 0.8, m = 0.5 * mass,
               period = 2.0 * 3.14159265358979323846 / std::sqrt(k_n / m);
  for (const double share : {0.002, 0.01, 0.03})
    for (const double start : {0.0, 0.3, 0.9}) {
      const double dt = share * period;
      double x = start * speed * dt, v = speed, most = 0.0, possible = 0.0;    // overlap and its rate
      for (int k = 0; x > 0.0 || k == 0; k++) {
        const double f = x > 0.0 ? -k_n * x : 0.0;
        const double before = 0.5 * m * v * v + (x > 0.0 ? 0.5 * k_n * x * x : 0.0);
        Restlessness now;
        now.add_swing(1.0, k_n, v * v, 0.5 * k_n * x * x, m);
        possible = possible_creation(dt, now, k_n, mass, mass, speed);
        const double half = v + 0.5 * dt * f / m;
        x += dt * half;
        v = half + 0.5 * dt * (x > 0.0 ? -k_n * x : 0.0) / m;
        const double created = 0.5 * m * v * v + (x > 0.0 ? 0.5 * k_n * x * x : 0.0) - before;
        EXPECT_LT(created, possible);
        most = std::max(most, created / possible);
      }
      EXPECT_GT(most, 1.0e-4);
    }
}
