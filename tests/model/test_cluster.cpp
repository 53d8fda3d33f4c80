// Particle count <-> diameter <-> mass.

#include "model_testing.h"

using namespace ClusterDEM;

TEST(ClusterGeometry, DiametersThatThePaperQuotes)
{
  // smallest, initial and largest cluster, printed in um to one decimal: half of the last digit
  EXPECT_NEAR(paper_geometry.diameter(3) * 1.0e6, 181.7, 0.05);
  EXPECT_NEAR(paper_geometry.diameter(400) * 1.0e6, 928.3, 0.05);
  EXPECT_NEAR(paper_geometry.diameter(2000) * 1.0e6, 1587.4, 0.05);
}

TEST(ClusterGeometry, MassOfOneParticle)
{
  // pi/6 (100 um)^3 2000 kg/m^3 = pi/3 1e-9 kg; three multiplications round
  EXPECT_TRUE(relatively_near(paper_geometry.particle_mass(), 1.0471975511965976e-9, 8.0 * EPS));
  EXPECT_TRUE(relatively_near(paper_geometry.mass(400), 4.1887902047863905e-7, 8.0 * EPS));
}

TEST(ClusterGeometry, ClusterAsASphereHasTheBulkDensity)
{
  // rho_p (1 - voidage) = 1000 kg/m^3 for the paper; a cube of a cube root costs a few roundings
  const double d = paper_geometry.diameter(400);
  EXPECT_TRUE(relatively_near(paper_geometry.mass(400) / (PI / 6.0 * d * d * d), 1000.0, 16.0 * EPS));
  EXPECT_EQ(paper_geometry.density(), 1000.0);
}

TEST(ClusterGeometry, SolidsFractionOfThePapersBoxes)
{
  // 5000 and 7750 clusters of 400 particles in 0.3 x 0.003 x 0.6 m: 0.194 % and 0.300 %, quoted to three
  // digits
  const double box = 0.3 * 0.003 * 0.6;
  EXPECT_NEAR(100.0 * 5000 * paper_geometry.mass(400) / 2000.0 / box, 0.194, 0.0005);
  EXPECT_NEAR(100.0 * 7750 * paper_geometry.mass(400) / 2000.0 / box, 0.300, 0.0007);    // 0.3006
}

TEST(ClusterGeometry, NominalDiameterIsNotAWholeNumber)
{
  // "928 um" is 399.59 particles, to two decimals
  EXPECT_NEAR(paper_geometry.particles_in(928.0e-6), 399.59, 0.005);
  const auto count = paper_geometry.count_from_mass(paper_geometry.mass(paper_geometry.particles_in(928.0e-6)));
  EXPECT_EQ(count.n, 400);
  EXPECT_NEAR(count.exact, 399.59, 0.005);
  EXPECT_FALSE(count.whole);
}

TEST(ClusterGeometry, OneParticleWithoutVoidIsItself)
{
  const ClusterGeometry solid{100.0e-6, 2000.0, 0.0};
  EXPECT_TRUE(relatively_near(solid.diameter(1), 100.0e-6, 2.0 * EPS));
  EXPECT_TRUE(relatively_near(solid.particles_in(100.0e-6), 1.0, 2.0 * EPS));
}

TEST(ClusterGeometry, RoundTripsForEveryCountOfThePaper)
{
  for (int n = 1; n <= 4000; n++) {
    // cbrt within 1 unit in the last place, cubed, and a few products: below 10 units
    ASSERT_TRUE(relatively_near(paper_geometry.particles_in(paper_geometry.diameter(n)), n, 10.0 * EPS));
    const auto count = paper_geometry.count_from_mass(paper_geometry.mass(n));
    ASSERT_EQ(count.n, n);
    ASSERT_TRUE(count.whole);
  }
}

TEST(ClusterGeometry, RoundTripsForAnyParticle)
{
  RandomInputs random(1);
  for (int k = 0; k < 20000; k++) {
    const ClusterGeometry g = random.geometry();
    const int n = random.integer(1, 2000000000);
    const double d = g.diameter(n);
    ASSERT_TRUE(std::isfinite(d) && d > 0.0);
    // 1 - voidage down to 0.05 divides and multiplies by the same number: still a few roundings
    ASSERT_TRUE(relatively_near(g.particles_in(d), n, 10.0 * EPS));
    const auto count = g.count_from_mass(g.mass(n));
    ASSERT_EQ(count.n, n);
    ASSERT_TRUE(count.whole);
    // volume of the sphere holds the particles at the voidage, by the definition
    ASSERT_TRUE(relatively_near(PI / 6.0 * d * d * d * (1.0 - g.voidage) * g.rho_p, g.mass(n), 16.0 * EPS));
  }
}

TEST(ClusterGeometry, WholeNumberWithinOneMillionth)
{
  // either side of the documented 1e-6 per particle of the cluster; 1e-9 is far above rounding
  for (int n : {1, 3, 400, 2000, 100000}) {
    for (double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(paper_geometry.count_from_mass(paper_geometry.mass(n * (1.0 + sign * (1.0e-6 - 1.0e-9)))).whole);
      EXPECT_FALSE(
          paper_geometry.count_from_mass(paper_geometry.mass(n * (1.0 + sign * (1.0e-6 + 1.0e-9)))).whole);
    }
  }
}

TEST(ClusterGeometry, MassesThatAreNoCluster)
{
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double m : {0.0, -1.0e-9, 0.49 * paper_geometry.particle_mass(), 10.0, 1.0e300, inf, -inf, nan}) {
    const auto count = paper_geometry.count_from_mass(m);
    EXPECT_EQ(count.n, 0) << m;
    EXPECT_FALSE(count.whole) << m;
  }
}

TEST(SizeLimits, DefaultsAreThePapers)
{
  EXPECT_EQ(SizeLimits().lo, 3);
  EXPECT_EQ(SizeLimits().hi, 2000);
}

TEST(SizeLimits, ClampFloors)
{
  const SizeLimits limits;
  EXPECT_EQ(limits.clamp(2.0), 3);
  EXPECT_EQ(limits.clamp(3.0), 3);
  EXPECT_EQ(limits.clamp(3.999), 3);
  EXPECT_EQ(limits.clamp(4.0), 4);
  EXPECT_EQ(limits.clamp(399.999), 399);
  EXPECT_EQ(limits.clamp(1999.999), 1999);
  EXPECT_EQ(limits.clamp(2000.0), 2000);
  EXPECT_EQ(limits.clamp(2001.0), 2000);
}

TEST(SizeLimits, ClampTakesAnyNumber)
{
  const SizeLimits limits;
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(limits.clamp(0.0), 3);
  EXPECT_EQ(limits.clamp(-1.0e300), 3);
  EXPECT_EQ(limits.clamp(-inf), 3);
  EXPECT_EQ(limits.clamp(1.0e300), 2000);    // far beyond int
  EXPECT_EQ(limits.clamp(inf), 2000);
  EXPECT_EQ(limits.clamp(std::numeric_limits<double>::quiet_NaN()), 3);
}
