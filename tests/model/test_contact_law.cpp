// Eqs. (3) and (4): closed forms of the linear spring-dashpot, limits of the friction law.

#include "model/contact_law.h"

#include <gtest/gtest.h>

#include <tuple>

using namespace ClusterDEM;

namespace {

ContactLaw table1(double e = 0.3)
{
  ContactLaw law;
  law.k_n = 10.0;
  law.e = e;
  law.mu = 0.33;
  law.derive();
  return law;
}

constexpr double MASS = 1.0e-7;

// One collision by small steps of a scheme of fourth order: overlap and approach when it is over, largest overlap.
std::tuple<double, double> collide(const ContactLaw &law, double speed)
{
  const double eta = law.damping(MASS), dt = 1.0e-4 * std::sqrt(MASS / law.k_n);
  double overlap = 0.0, rate = speed, peak = 0.0;    // rate of the overlap
  auto acceleration = [&](double d, double r) { return -law.normal(d, eta, -r) / MASS; };
  do {
    const double k1 = rate, a1 = acceleration(overlap, rate);
    const double k2 = rate + 0.5 * dt * a1, a2 = acceleration(overlap + 0.5 * dt * k1, k2);
    const double k3 = rate + 0.5 * dt * a2, a3 = acceleration(overlap + 0.5 * dt * k2, k3);
    const double k4 = rate + dt * a3, a4 = acceleration(overlap + dt * k3, k4);
    overlap += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    rate += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    peak = std::max(peak, overlap);
  } while (overlap > 0.0);
  return {-rate, peak};
}

}    // namespace

TEST(ContactLaw, ReducedMass)
{
  EXPECT_DOUBLE_EQ(reduced_mass(3.0, 6.0), 2.0);
}

TEST(ContactLaw, PublishedDampingRatio)
{
  EXPECT_NEAR(damping_ratio(0.3), 0.358, 5.0e-4);    // MODEL section 3
  EXPECT_EQ(damping_ratio(1.0), 0.0);
  EXPECT_EQ(damping_ratio(0.0), 1.0);
  EXPECT_NEAR(damping_ratio(1.0e-300), 1.0, 1.0e-4);    // and the limit is reached without a jump
}

TEST(ContactLaw, ReboundIsTheCoefficientOfRestitution)
{
  // to 1e-3: the last step leaves the contact by up to 1e-4 of a period
  for (double e : {0.1, 0.3, 0.9, 1.0}) {
    const auto [rebound, peak] = collide(table1(e), 2.0);
    EXPECT_NEAR(rebound, 2.0 * e, 2.0e-3) << e;
  }
}

TEST(ContactLaw, PeakOverlapInClosedForm)
{
  for (double e : {0.0, 1.0e-8, 0.1, 0.3, 0.9, 1.0}) {
    const ContactLaw law = table1(e);
    if (e > 0.01) {
      EXPECT_NEAR(law.peak_overlap(MASS, 0.0, 2.0) / std::get<1>(collide(law, 2.0)), 1.0, 1.0e-6) << e;
    }
    // and from the middle of the way the peak is the same
    const double w0 = std::sqrt(law.k_n / MASS), b = damping_ratio(e) * w0, t = 0.1 / w0;
    const double w = std::sqrt(std::max(1.0e-30, w0 * w0 - b * b));
    const double overlap = std::exp(-b * t) * 2.0 * (w > 1.0e-6 * w0 ? std::sin(w * t) / w : t);
    const double rate = std::exp(-b * t) * 2.0 * (w > 1.0e-6 * w0 ? std::cos(w * t) : 1.0) - b * overlap;
    EXPECT_NEAR(law.peak_overlap(MASS, overlap, rate) / law.peak_overlap(MASS, 0.0, 2.0), 1.0, 1.0e-6) << e;
  }
  EXPECT_EQ(table1().peak_overlap(MASS, 1.0e-5, 0.0), 1.0e-5);
  EXPECT_EQ(table1().peak_overlap(MASS, 1.0e-5, -1.0), 1.0e-5);
}

TEST(ContactLaw, PublishedOverlapPerSpeed)
{
  // MODEL section 6: two clusters of 400 particles overlap by 9.8 % of d per m/s of approach
  const double m = 0.5 * 400.0 * CONTACT_PI / 6.0 * 1.0e-12 * 2000.0, d = 1.0e-4 * std::cbrt(800.0);
  EXPECT_NEAR(table1().peak_overlap(m, 0.0, 1.0) / d, 0.098, 5.0e-4);
}

TEST(ContactLaw, StifferSpringsOverlapLess)
{
  ContactLaw law = table1();
  const double peak = law.peak_overlap(MASS, 0.0, 2.0);
  law.k_n = law.stiffness_for(peak, 0.25 * peak);
  law.derive();
  EXPECT_NEAR(law.peak_overlap(MASS, 0.0, 2.0), 0.25 * peak, 1.0e-12 * peak);
  law.e = 1.0;
  law.k_n = stopping_stiffness(MASS, 2.0, peak);
  law.derive();
  EXPECT_NEAR(law.peak_overlap(MASS, 0.0, 2.0), peak, 1.0e-12 * peak);
}

TEST(ContactLaw, SlipLimits)
{
  EXPECT_NEAR(slip_ratio_poisson(0.33, 0.25), 0.33 * 1.75 / 1.5, 1.0e-15);
  EXPECT_NEAR(stiffness_ratio(0.25), 0.857142857, 1.0e-9);    // MODEL section 3
  // delta_max from nu is delta_max from this stiffness
  const double k_t = 1.5 * 10.0 * 2.0 * (1.0 - 0.25) / (2.0 - 0.25);
  EXPECT_NEAR(slip_ratio_stiffness(0.33, 10.0, k_t), slip_ratio_poisson(0.33, 0.25), 1.0e-15);
}

TEST(ContactLaw, FrictionOfEquation4)
{
  const ContactLaw law = table1(1.0);    // eta = 0
  const double overlap = 1.0e-5, f_n = law.normal(overlap, 0.0, 0.0), limit = 0.33 * f_n;
  const double most = law.slip_limit(overlap);
  const Vec3 still{0.0, 0.0, 0.0};
  for (double share : {0.0, 0.1, 0.5, 0.9, 1.0, 3.0}) {
    Vec3 s{share * most, 0.0, 0.0};
    const Vec3 force = law.friction(overlap, f_n, 0.0, still, s);
    const double expected = limit * (1.0 - std::pow(1.0 - std::min(share, 1.0), 1.5));
    EXPECT_NEAR(force[0], -expected, 1.0e-12 * limit) << share;
    EXPECT_NEAR(s[0], std::min(share, 1.0) * most, 1.0e-12 * most);    // cut back while it slides
  }
  EXPECT_NEAR(law.tangential_energy(overlap, f_n, {most, 0.0, 0.0}), 0.6 * limit * most, 1.0e-12 * limit * most);
}

TEST(ContactLaw, TangentialEnergyIsTheIntegralOfTheForce)
{
  for (Tangential kind : {Tangential::MD, Tangential::LINEAR}) {
    ContactLaw law = table1(1.0);
    law.tangential = kind;
    law.derive();
    const double overlap = 1.0e-5, f_n = law.normal(overlap, 0.0, 0.0), end = 0.3 * law.slip_limit(overlap);
    const int n = 20000;
    double work = 0.0;
    for (int k = 0; k < n; k++) {
      Vec3 s{0.0, 0.0, end * (k + 0.5) / n};
      work -= law.friction(overlap, f_n, 0.0, {0.0, 0.0, 0.0}, s)[2] * end / n;
    }
    EXPECT_NEAR(law.tangential_energy(overlap, f_n, {0.0, 0.0, end}) / work, 1.0, 1.0e-6);
  }
}

TEST(ContactLaw, NoFrictionBeyondCoulombsLimit)
{
  for (Tangential kind : {Tangential::MD, Tangential::LINEAR})
    for (FrictionDirection direction : {FrictionDirection::DISPLACEMENT, FrictionDirection::VELOCITY})
      for (double speed : {0.0, 1.0e-3, 1.0, 100.0})
        for (double share : {0.0, 0.5, 2.0, 100.0}) {
          ContactLaw law = table1();
          law.tangential = kind;
          law.direction = direction;
          law.derive();
          const double overlap = 1.0e-5, f_n = law.normal(overlap, law.damping(MASS), 0.1);
          Vec3 s{0.0, share * law.slip_limit(overlap), 0.0};
          const Vec3 v{speed, 0.0, 0.0};
          const Vec3 force = law.friction(overlap, f_n, law.damping(MASS), v, s);
          EXPECT_LE(norm(force), 0.33 * std::fabs(f_n) * (1.0 + 1.0e-12));
          if (direction == FrictionDirection::VELOCITY) { EXPECT_LE(dot(force, v), 0.0); }
        }
}

TEST(ContactLaw, PrintedDirectionOpposesTheVelocity)
{
  ContactLaw law = table1(1.0);
  law.direction = FrictionDirection::VELOCITY;
  law.derive();
  Vec3 s{2.0e-6, 0.0, 0.0};
  const Vec3 force = law.friction(1.0e-5, 1.0e-4, 0.0, {0.0, 0.0, -0.5}, s);
  EXPECT_EQ(force[0], 0.0);
  EXPECT_GT(force[2], 0.0);
  EXPECT_EQ(law.tangential_energy(1.0e-5, 1.0e-4, s), 0.0);    // nothing to give back
}

TEST(ContactLaw, DisplacementTurnsWithTheContact)
{
  const Vec3 turned = turn_into_plane({3.0, 0.0, 4.0}, {0.0, 0.0, 1.0});
  EXPECT_NEAR(turned[0], 5.0, 1.0e-12);
  EXPECT_NEAR(turned[2], 0.0, 1.0e-12);
  EXPECT_EQ(turn_into_plane({0.0, 0.0, 4.0}, {0.0, 0.0, 1.0}), (Vec3{0.0, 0.0, 0.0}));
}
