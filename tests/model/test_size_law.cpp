// The size law: each power by hand, K of the EMMS literature re-derived, l and n within their limits.

#include "model_testing.h"

#include "model/size_law.h"

using namespace ClusterDEM;

namespace {
const SizeLimits limits;
const double d_lo = paper_geometry.diameter(3), d_hi = paper_geometry.diameter(2000);
}    // namespace

TEST(SizeLaw, DefaultReadingsAreTheFirst)
{
  EXPECT_EQ(NstReading{}, NstReading::PARTICLE);
  EXPECT_EQ(NsmfReading{}, NsmfReading::EMMS);
  EXPECT_EQ(UpReading{}, UpReading::OWN);
}

// ---- U_mf ----

TEST(WenYuUmf, ThePapersGasAndParticle)
{
  // 6.46 mm/s, to three digits
  EXPECT_NEAR(umf_wen_yu(100.0e-6, 2000.0, paper_gas, gravity) * 1.0e3, 6.46, 0.005);
}

TEST(WenYuUmf, SolvesItsQuadratic)
{
  // (Re + 33.7)^2 = 33.7^2 + 0.0408 Ar, written Re (Re + 67.4) = 0.0408 Ar so that nothing cancels
  RandomInputs random(20);
  for (int k = 0; k < 20000; k++) {
    const ClusterGeometry g = random.geometry();
    const Gas gas = random.gas();
    if (g.rho_p <= gas.rho) continue;
    const double u = umf_wen_yu(g.d_p, g.rho_p, gas, gravity);
    const double ar = gravity * std::pow(g.d_p, 3.0) * (g.rho_p - gas.rho) / (gas.rho * gas.nu * gas.nu);
    const double re = u * g.d_p / gas.nu;
    // some fifteen roundings; the square root halves its own
    ASSERT_TRUE(relatively_near(re * (re + 67.4), 0.0408 * ar, 30.0 * EPS));
  }
}

TEST(WenYuUmf, LimitsOfSmallAndLargeParticles)
{
  // Ar -> 0: Re = 0.0408 Ar/67.4, off by Re/67.4 itself (Re = 3e-5 here); Ar -> inf: Re = sqrt(0.0408 Ar)
  // - 33.7
  auto archimedes = [](double d) { return gravity * d * d * d * (2000.0 - 1.2) / (1.2 * 1.53e-5 * 1.53e-5); };
  double d = 5.0e-6;
  EXPECT_TRUE(relatively_near(umf_wen_yu(d, 2000.0, paper_gas, gravity) * d / paper_gas.nu,
                              0.0408 * archimedes(d) / 67.4, 1.0e-5));
  d = 1.0;
  EXPECT_TRUE(relatively_near(umf_wen_yu(d, 2000.0, paper_gas, gravity) * d / paper_gas.nu,
                              std::sqrt(0.0408 * archimedes(d)) - 33.7, 1.0e-6));    // (33.7/Re)^2/2, Re = 5e4
}

TEST(WenYuUmf, NothingToFluidize)
{
  EXPECT_EQ(umf_wen_yu(100.0e-6, 1.2, paper_gas, gravity), 0.0);
  EXPECT_EQ(umf_wen_yu(100.0e-6, 0.5, paper_gas, gravity), 0.0);    // lighter than the gas
  EXPECT_EQ(umf_wen_yu(100.0e-6, 2000.0, paper_gas, 0.0), 0.0);
}

// ---- the three powers, by hand ----

TEST(Nst, ByHand)
{
  // drag that carries the weight of the solids, in gas of 2 m/s: 2 g = 19.62 W/kg, of a particle or of a
  // cluster alike
  for (double mass : {paper_geometry.mass(1), paper_geometry.mass(400)})
    EXPECT_TRUE(relatively_near(n_st({0.0, 0.0, mass * gravity}, {0.0, 0.0, 2.0}, mass), 19.62, 4.0 * EPS));
  // all components count: (1 2 + 2 3 + 3 4)/5
  EXPECT_DOUBLE_EQ(n_st({1.0, 2.0, 3.0}, {2.0, 3.0, 4.0}, 5.0), 4.0);
}

TEST(Nst, KeepsItsSign)
{
  // a cluster faster than the gas is braked: negative, and stays so
  EXPECT_DOUBLE_EQ(n_st({0.0, 0.0, -3.0}, {0.0, 0.0, 2.0}, 1.5), -4.0);
}

TEST(Ncc, ByHand)
{
  EXPECT_DOUBLE_EQ(n_cc(3.0e-6, 2.0e-7, 1.0), 15.0);
  EXPECT_DOUBLE_EQ(n_cc(-3.0e-6, 2.0e-7, 1.0), 15.0);    // the magnitude of the sum
  EXPECT_DOUBLE_EQ(n_cc(-3.0e-6, 2.0e-7, 0.1), 1.5);
  EXPECT_EQ(n_cc(3.0e-6, 2.0e-7, 0.0), 0.0);
}

TEST(Nsmf, BothReadingsByHand)
{
  // (0.00646 + 0.5 2/0.5) 9.81 = 19.6833726 and (0.00646 + 2/0.5) 9.81 = 39.3033726
  EXPECT_TRUE(relatively_near(n_smf(NsmfReading::EMMS, 0.00646, 2.0, 0.5, gravity), 19.6833726, 8.0 * EPS));
  EXPECT_TRUE(relatively_near(n_smf(NsmfReading::PAPER, 0.00646, 2.0, 0.5, gravity), 39.3033726, 8.0 * EPS));
  // eps_mf other than 0.5 tells eps from 1 - eps: (0.01 + 0.4 3/0.6) 10 and (0.01 + 3/0.6) 10
  EXPECT_TRUE(relatively_near(n_smf(NsmfReading::EMMS, 0.01, 3.0, 0.4, 10.0), 20.1, 8.0 * EPS));
  EXPECT_TRUE(relatively_near(n_smf(NsmfReading::PAPER, 0.01, 3.0, 0.4, 10.0), 50.1, 8.0 * EPS));
}

// ---- K ----

TEST(KEmms, ByHand)
{
  // 100 um [0.03/0.0003 - (0.00646 + 0.5 0.03/0.5)] 9.81 = 1e-4 (100 - 0.03646) 9.81; 1 - 0.9997 keeps 12
  // digits
  EXPECT_TRUE(relatively_near(k_emms(100.0e-6, 0.03, 0.00646, 0.5, gravity), 1.0e-4 * 99.96354 * 9.81, 1.0e-11));
}

TEST(KEmms, RederivedFromItsTwoConditions)
{
  // l = K/(N - N_smf) with l = d_p where N = U_p g/(1 - eps_max), and l -> inf where N -> N_smf
  RandomInputs random(21);
  for (int k = 0; k < 20000; k++) {
    const double d_p = random.log_uniform(1.0e-6, 5.0e-3), u_p = random.log_uniform(1.0e-3, 300.0);
    const double u_mf = random.log_uniform(1.0e-6, 1.0e-1 * u_p), eps_mf = random.uniform(0.3, 0.7);
    const double eps_max = random.uniform(0.99, 0.9999), g = random.uniform(1.0, 20.0);
    const double K = k_emms(d_p, u_p, u_mf, eps_mf, g, eps_max);
    const double mf = n_smf(NsmfReading::EMMS, u_mf, u_p, eps_mf, g);
    // the dilute term is at least 30 times what is subtracted: a few roundings
    ASSERT_TRUE(relatively_near(K / (u_p * g / (1.0 - eps_max) - mf), d_p, 16.0 * EPS));
    ASSERT_GT(K, 0.0);
    // an energy 1e-6 above N_smf, relative: l is huge, and grows as the excess shrinks
    const double near = K / (mf * (1.0 + 1.0e-6) - mf), nearer = K / (mf * (1.0 + 1.0e-9) - mf);
    ASSERT_GT(near, 1.0e6 * d_p);
    ASSERT_GT(nearer, 100.0 * near);
  }
}

// ---- l and n ----

TEST(StableSize, ByHand)
{
  // K = 0.0266 m W/kg, E = 50 W/kg: l = 532 um, floor(0.5 5.32^3) = floor(75.28) = 75
  const StableSize s = stable_size(0.0266, 50.0, paper_geometry, limits);
  EXPECT_TRUE(relatively_near(s.l, 532.0e-6, 4.0 * EPS));
  EXPECT_EQ(s.n, 75);
}

TEST(StableSize, NoEnergyMeansTheUpperLimit)
{
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (double e : {0.0, -0.0, -1.0e-300, -20.0, -1.0e300, -inf, nan}) {
    const StableSize s = stable_size(0.0266, e, paper_geometry, limits);
    EXPECT_EQ(s.n, 2000) << e;
    EXPECT_EQ(s.l, d_hi) << e;
  }
}

TEST(StableSize, LimitsOfTheSize)
{
  EXPECT_EQ(stable_size(0.0266, 1.0e300, paper_geometry, limits).n, 3);
  EXPECT_EQ(stable_size(0.0266, 1.0e300, paper_geometry, limits).l, d_lo);
  EXPECT_EQ(stable_size(0.0266, 5.0e-324, paper_geometry, limits).n, 2000);    // K/E overflows
  EXPECT_EQ(stable_size(0.0266, 5.0e-324, paper_geometry, limits).l, d_hi);
  EXPECT_EQ(stable_size(0.0, 1.0, paper_geometry, limits).n, 3);
  EXPECT_EQ(stable_size(0.0266, 50.0, paper_geometry, {100, 200}).n, 100);
  EXPECT_EQ(stable_size(0.0266, 50.0, paper_geometry, {3, 50}).n, 50);
}

TEST(StableSize, ADiameterMadeFromNGivesNBack)
{
  RandomInputs random(22);
  for (int n = 3; n <= 2000; n++) {
    const double d = paper_geometry.diameter(n);
    for (double e : {1.0, 3.0, 0.1, random.log_uniform(1.0e-6, 1.0e6), random.log_uniform(1.0e-6, 1.0e6)}) {
      const StableSize s = stable_size(d * e, e, paper_geometry, limits);
      ASSERT_EQ(s.n, n) << e;
      ASSERT_TRUE(relatively_near(s.l, d, 2.0 * EPS)) << e;    // one product, one quotient
    }
    // but a diameter 1e-11 smaller, far beyond rounding, holds one particle less
    if (n > 3) { ASSERT_EQ(stable_size(d * (1.0 - 1.0e-11), 1.0, paper_geometry, limits).n, n - 1); }
  }
}

TEST(StableSize, WithinItsLimitsAndConsistentForAnyInput)
{
  RandomInputs random(23);
  for (int k = 0; k < 50000; k++) {
    const ClusterGeometry g = random.geometry();
    SizeLimits l;
    l.lo = random.integer(1, 1000);
    l.hi = l.lo + random.integer(0, 100000);
    const double K = random.log_uniform(1.0e-300, 1.0e300);
    // half over the whole range, half where l lies between the limits
    double e = random.log_uniform(1.0e-300, 1.0e300);
    if (random.coin()) e = K / random.uniform(g.diameter(l.lo), g.diameter(l.hi));
    const StableSize s = stable_size(K, e, g, l);
    ASSERT_GE(s.n, l.lo);
    ASSERT_LE(s.n, l.hi);
    ASSERT_GE(s.l, g.diameter(l.lo));
    ASSERT_LE(s.l, g.diameter(l.hi));
    // n is the largest whole number of particles in l; 2e-12 covers the header's own allowance of 1e-12
    ASSERT_LE(s.n, g.particles_in(s.l) * (1.0 + 2.0e-12));
    if (s.n < l.hi) { ASSERT_GT(s.n + 1, g.particles_in(s.l)); }
  }
}

TEST(StableSize, FallsWithTheEnergy)
{
  int before = 2000;
  for (double e = 1.0e-3; e < 1.0e4; e *= 1.01) {
    const int n = stable_size(0.0266, e, paper_geometry, limits).n;
    ASSERT_LE(n, before);
    before = n;
  }
  EXPECT_EQ(before, 3);
}
