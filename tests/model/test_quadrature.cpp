// Energies of contact laws by integration of their forces, against closed forms.

#include "model/contact_law.h"
#include "model/quadrature.h"

#include <gtest/gtest.h>

using namespace ClusterDEM;

constexpr double K = 1.7e5, R = 2.3e-4, OVERLAP = 7.1e-6;

TEST(Quadrature, LinearHertzAndDmtToRounding)
{
  const double linear = integral_from_edge([](double x) { return K * x; }, 0.0, OVERLAP);
  EXPECT_NEAR(linear / linear_energy(K, OVERLAP), 1.0, 1.0e-14);

  const double hertz =
      integral_from_edge([](double x) { return K * std::sqrt(R) * x * std::sqrt(x); }, 0.0, OVERLAP);
  EXPECT_NEAR(hertz / (0.4 * K * std::sqrt(R) * std::pow(OVERLAP, 2.5)), 1.0, 1.0e-14);
  EXPECT_NEAR(hertz_energy(K, R, OVERLAP) / hertz, 1.0, 1.0e-14);

  const double pull = 0.03;
  const double dmt =
      integral_from_edge([&](double x) { return K * std::sqrt(R) * x * std::sqrt(x) - pull; }, 0.0, OVERLAP);
  EXPECT_NEAR(dmt / (0.4 * K * std::sqrt(R) * std::pow(OVERLAP, 2.5) - pull * OVERLAP), 1.0, 1.0e-13);
}

// JKR: overlap and force as functions of the contact radius a, with surface energy g and stiffness E; from the largest pull on
// (Johnson, Kendall & Roberts 1971). The integral of F d(overlap) is a polynomial in sqrt(a).
TEST(Quadrature, Jkr)
{
  const double e = 1.0e5, g = 0.02, pi = CONTACT_PI;
  auto overlap = [&](double a) { return a * a / R - 2.0 * std::sqrt(pi * g * a / e); };
  auto force = [&](double a) { return 4.0 * e * a * a * a / (3.0 * R) - 4.0 * std::sqrt(pi * g * e * a * a * a); };
  auto energy = [&](double a) {
    return 8.0 * e * std::pow(a, 5) / (15.0 * R * R) - 8.0 / 3.0 * std::sqrt(pi * g * e) * std::pow(a, 3.5) / R +
        2.0 * pi * g * a * a;
  };
  auto radius_at = [&](double at, double lo, double hi) {
    for (int k = 0; k < 200; k++) (overlap(0.5 * (lo + hi)) < at ? lo : hi) = 0.5 * (lo + hi);
    return 0.5 * (lo + hi);
  };
  const double least = std::cbrt(9.0 * pi * g * R * R / (4.0 * e));
  EXPECT_NEAR(force(least), -3.0 * pi * g * R, 1.0e-12 * g * R);
  for (const double a : {1.01 * least, 1.6 * least, 3.0 * least, 8.0 * least}) {
    const double integral = integral_from_edge(
        [&](double x) { return force(radius_at(x, 0.9 * least, 9.0 * least)); }, overlap(least), overlap(a));
    EXPECT_NEAR(integral / (energy(a) - energy(least)), 1.0, 1.0e-9) << a / least;
  }
}
