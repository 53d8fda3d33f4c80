// Drag laws: printed values, limits, a published drag benchmark, and the exponential step.

#include "model_testing.h"

#include <string>

using namespace ClusterDEM;

namespace {

double cd(const DragLaw &law, double re)
{
  return law.cd_re(re) / re;
}

// every law of the registry with legal parameters, drawn anew
std::vector<std::unique_ptr<DragLaw>> every_law(RandomInputs &random)
{
  std::vector<std::unique_ptr<DragLaw>> laws;
  for (const DragLawEntry &entry : drag_laws()) {
    std::vector<double> p;
    for (const DragParameter &parameter : entry.parameters)
      p.push_back(random.coin() ? parameter.hi : random.uniform(parameter.lo + 1.0e-3, parameter.hi));
    laws.push_back(entry.make(p.data()));
  }
  return laws;
}

}    // namespace

// ---- Tran-Cong, Gay & Michaelides ----

TEST(TranCong, PublishedValues)
{
  const TranCongDrag sphere(1.0, 1.0), agglomerate(0.8, 1.1);
  // given to 4 or 5 decimals: half of the last digit
  EXPECT_NEAR(cd(sphere, 1.0), 27.6000, 0.5e-4);
  EXPECT_NEAR(cd(sphere, 100.0), 1.09379, 0.5e-5);
  EXPECT_NEAR(cd(sphere, 1000.0), 0.46615, 0.5e-5);
  EXPECT_NEAR(cd(agglomerate, 1.0), 31.1270, 0.5e-4);
  EXPECT_NEAR(cd(agglomerate, 100.0), 1.38548, 0.5e-5);
  EXPECT_NEAR(cd(agglomerate, 1000.0), 0.61216, 0.5e-5);
}

TEST(TranCong, EqualsThePrintedFormula)
{
  RandomInputs random(2);
  for (int k = 0; k < 20000; k++) {
    const double c = random.uniform(0.4, 1.0), r = random.uniform(0.8, 1.5),
                 re = random.log_uniform(1.0e-3, 1.0e6);
    const double printed = 24.0 / re * r * (1.0 + 0.15 / std::sqrt(c) * std::pow(r * re, 0.687)) +
        0.42 * r * r / (std::sqrt(c) * (1.0 + 4.25e4 * std::pow(r * re, -1.16)));
    // two ways to round a dozen operations, none of which cancels; powers by a logarithm (up to 1.16 ln 1e6 =
    // 16) carry its rounding, 16 EPS
    ASSERT_TRUE(relatively_near(cd(TranCongDrag(c, r), re), printed, 30.0 * EPS)) << c << " " << r << " " << re;
  }
}

TEST(TranCong, StokesLimitCarriesTheFirstFactor)
{
  // C_D Re -> 24 d_A/d_n; at Re = 1e-12 the correction is 0.15 Re^0.687 = 9e-10
  EXPECT_DOUBLE_EQ(TranCongDrag(0.8, 1.1).cd_re(0.0), 24.0 * 1.1);
  EXPECT_TRUE(relatively_near(TranCongDrag(1.0, 1.0).cd_re(1.0e-12), 24.0, 1.0e-9));
}

TEST(TranCong, HighReynoldsLimit)
{
  // the second term tends to 0.42 r^2/sqrt(c): beyond Re = 1e12 the 4.25e4 (r Re)^-1.16 is below 1e-9
  const double c = 0.8, r = 1.1, re = 1.0e12;
  const double second =
      cd(TranCongDrag(c, r), re) - 24.0 / re * r * (1.0 + 0.15 / std::sqrt(c) * std::pow(r * re, 0.687));
  EXPECT_TRUE(relatively_near(second, 0.42 * r * r / std::sqrt(c), 1.0e-9));
}

// ---- Schiller & Naumann, Stokes ----

TEST(SchillerNaumann, KnownValues)
{
  const SchillerNaumannDrag law;
  EXPECT_DOUBLE_EQ(cd(law, 1.0), 27.6);    // 24 (1 + 0.15)
  // 100^0.687 = 23.659197: 0.24 (1 + 0.15 23.659197); seven digits were worked out
  EXPECT_NEAR(cd(law, 100.0), 1.0917311, 1.0e-7);
  EXPECT_DOUBLE_EQ(cd(law, 1.0e5), 0.44);    // Newton's range
  EXPECT_DOUBLE_EQ(cd(law, 1000.0), 0.44);
  EXPECT_EQ(law.cd_re(0.0), 24.0);
}

TEST(SchillerNaumann, ContinuousWhereTheNewtonRangeBegins)
{
  // a step of 1e-6 in Re moves C_D Re by no more than its slope, 0.44 < dC_D Re/dRe < 24, allows
  const SchillerNaumannDrag law;
  for (double re = 900.0; re < 1100.0; re += 0.5)
    ASSERT_LE(std::fabs(law.cd_re(re * (1.0 + 1.0e-9)) - law.cd_re(re)), 24.0 * re * 1.0e-9 * 2.0);
}

TEST(Stokes, ForceIsThreePiMuDV)
{
  // Stokes' own form: F = 3 pi mu d V, at any slip
  RandomInputs random(3);
  for (int k = 0; k < 10000; k++) {
    const Gas gas = random.gas();
    const double d = random.log_uniform(1.0e-6, 5.0e-3), slip = random.uniform(0.0, 300.0);
    // five products, each rounds
    ASSERT_TRUE(
        relatively_near(drag_coefficient(StokesDrag(), gas, d, slip), 3.0 * PI * gas.rho * gas.nu * d, 8.0 * EPS));
  }
}

TEST(DragForce, EqualsTheDefinitionOfTheDragCoefficient)
{
  // F = C_D (rho/2) (pi d^2/4) V^2
  RandomInputs random(4);
  const SchillerNaumannDrag law;
  for (int k = 0; k < 10000; k++) {
    const Gas gas = random.gas();
    const double d = random.log_uniform(1.0e-6, 5.0e-3), v = random.log_uniform(1.0e-6, 300.0);
    const double definition = cd(law, v * d / gas.nu) * 0.5 * gas.rho * PI / 4.0 * d * d * v * v;
    ASSERT_TRUE(
        relatively_near(drag_coefficient(law, gas, d, v) * v, definition, 20.0 * EPS));    // a dozen roundings
  }
}

TEST(DragForce, FiniteAtRest)
{
  // the Stokes force, not 0/0
  EXPECT_TRUE(relatively_near(drag_coefficient(SchillerNaumannDrag(), paper_gas, 100.0e-6, 0.0),
                              3.0 * PI * 1.2 * 1.53e-5 * 100.0e-6, 8.0 * EPS));
  EXPECT_EQ(reynolds(0.0, 100.0e-6, paper_gas), 0.0);
  EXPECT_TRUE(relatively_near(reynolds(0.153, 1.0e-4, paper_gas), 1.0, 4.0 * EPS));
}

// ---- laws of suspensions ----

TEST(WenYu, OneSphereInClearGas)
{
  RandomInputs random(5);
  for (int k = 0; k < 1000; k++) {
    const double re = random.log_uniform(1.0e-6, 1.0e6);
    ASSERT_EQ(WenYuDrag(1.0).cd_re(re), SchillerNaumannDrag().cd_re(re));
  }
}

TEST(WenYu, EqualsTheExchangeCoefficientOfTheLiterature)
{
  // beta = 3/4 C_D(eps Re) eps (1 - eps) rho |u - V| / d eps^-2.65 per volume, shared by (1 - eps)/V_p
  // particles
  RandomInputs random(6);
  for (int k = 0; k < 10000; k++) {
    const double eps = random.uniform(0.3, 1.0), d = random.log_uniform(1.0e-6, 5.0e-3),
                 v = random.log_uniform(1.0e-4, 300.0);
    const double re = v * d / paper_gas.nu;
    const double beta_per_solids =
        0.75 * cd(SchillerNaumannDrag(), eps * re) * eps * paper_gas.rho * v / d * std::pow(eps, -2.65);
    const double b = drag_coefficient(WenYuDrag(eps), paper_gas, d, v);
    ASSERT_TRUE(
        relatively_near(b, beta_per_solids * PI / 6.0 * d * d * d, 30.0 * EPS));    // some twenty roundings
  }
}

TEST(DiFelice, OneSphereInClearGasIsDallaValle)
{
  const DiFeliceDrag law(1.0);
  for (double re : {1.0e-3, 1.0, 31.6, 1.0e3, 1.0e6}) {
    const double dalla_valle = 0.63 + 4.8 / std::sqrt(re);
    // two ways to round a square and a root
    EXPECT_TRUE(relatively_near(cd(law, re), dalla_valle * dalla_valle, 10.0 * EPS)) << re;
  }
  EXPECT_TRUE(relatively_near(law.cd_re(0.0), 23.04, 4.0 * EPS));    // 4.8^2
}

TEST(DiFelice, ExponentOfTheVoidage)
{
  // beta = 3.7 at both ends, 3.05 where log10 Re_eps = 1.5; single-sphere drag on the superficial slip eps V,
  // times eps^-beta
  const double eps = 0.6;
  auto beta = [&](double re_eps) {
    const double sphere =
        DiFeliceDrag(1.0).cd_re(re_eps);    // C_D Re_eps; the force scales with it and with eps V
    return -std::log(DiFeliceDrag(eps).cd_re(re_eps / eps) / (sphere * eps)) / std::log(eps);
  };
  EXPECT_NEAR(beta(std::pow(10.0, 1.5)), 3.05, 1.0e-13);    // rounding of two logarithms
  EXPECT_NEAR(beta(1.0), 3.7 - 0.65 * std::exp(-1.125), 1.0e-13);
  EXPECT_NEAR(beta(1.0e-12), 3.7, 1.0e-13);    // exp(-91)
  EXPECT_NEAR(beta(1.0e15), 3.7, 1.0e-13);
  // and the value at rest is the limit, not a branch of its own: beta is 3.7 there, and C_D Re differs by
  // 0.63 sqrt(Re)
  EXPECT_TRUE(relatively_near(DiFeliceDrag(eps).cd_re(0.0), DiFeliceDrag(eps).cd_re(1.0e-20), 1.0e-9));
}

// ---- all laws ----

TEST(DragLaws, RegistryNamesWhatTheCommandTakes)
{
  const std::vector<std::pair<std::string, std::size_t>> expected = {
      {"trancong", 2}, {"schiller/naumann", 0}, {"stokes", 0}, {"wen/yu", 1}, {"difelice", 1}, {"none", 0}};
  for (const auto &[name, parameters] : expected) {
    bool found = false;
    for (const DragLawEntry &entry : drag_laws())
      if (name == entry.name) {
        found = true;
        EXPECT_EQ(entry.parameters.size(), parameters) << name;
      }
    EXPECT_TRUE(found) << name;
  }
}

TEST(DragLaws, RegistryMakesTheLawOfThatName)
{
  // Re = 50, parameters of Tran-Cong in their order: circularity, then d_A/d_n
  const double p[] = {0.8, 1.1};
  for (const DragLawEntry &entry : drag_laws()) {
    const std::string name = entry.name;
    const double made = entry.make(p)->cd_re(50.0);
    if (name == "trancong") { EXPECT_EQ(made, TranCongDrag(0.8, 1.1).cd_re(50.0)); }
    if (name == "schiller/naumann") { EXPECT_EQ(made, SchillerNaumannDrag().cd_re(50.0)); }
    if (name == "stokes") { EXPECT_EQ(made, 24.0); }
    if (name == "wen/yu") { EXPECT_EQ(made, WenYuDrag(0.8).cd_re(50.0)); }
    if (name == "difelice") { EXPECT_EQ(made, DiFeliceDrag(0.8).cd_re(50.0)); }
    if (name == "none") { EXPECT_EQ(made, 0.0); }
  }
}

TEST(DragLaws, NeverNegativeNorNotANumber)
{
  RandomInputs random(7);
  for (int k = 0; k < 5000; k++) {
    for (const auto &law : every_law(random)) {
      for (double re :
           {0.0, 5.0e-324, random.log_uniform(1.0e-300, 1.0e300), random.log_uniform(1.0e-3, 1.0e6), 1.0e300}) {
        const double value = law->cd_re(re);
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0) << re << " " << value;
      }
    }
  }
}

TEST(DragLaws, ForceGrowsWithTheSlip)
{
  RandomInputs random(8);
  for (int k = 0; k < 5000; k++) {
    for (const auto &law : every_law(random)) {
      const double re = random.log_uniform(1.0e-6, 1.0e8);
      // 1 % more slip: C_D Re of every law is non-decreasing or falls slower than 1/Re, so force does not
      // fall; 4 units in the last place for the law none and for rounding
      ASSERT_GE(1.01 * law->cd_re(1.01 * re), law->cd_re(re) * (1.0 - 4.0 * EPS)) << re;
    }
  }
}

TEST(ClusterDrag, SharesBetweenClusterAndParticles)
{
  RandomInputs random(9);
  const TranCongDrag law(0.8, 1.1);
  for (int k = 0; k < 10000; k++) {
    const int n = random.integer(3, 2000);
    const double d = paper_geometry.diameter(n), d_p = paper_geometry.d_p, v = random.uniform(0.0, 300.0);
    const double cluster = drag_coefficient(law, paper_gas, d, v);
    const double particles = n * drag_coefficient(law, paper_gas, d_p, v);
    const double share = random.uniform(0.0, 1.0);
    auto b = [&](double f) { return cluster_drag_coefficient(law, paper_gas, d, d_p, n, f, v); };
    ASSERT_EQ(b(0.0), cluster);
    ASSERT_EQ(b(1.0), particles);
    // a weighted sum of two positive numbers: three roundings
    ASSERT_TRUE(relatively_near(b(share), (1.0 - share) * cluster + share * particles, 4.0 * EPS));
  }
}

// ---- MFiX DEM06: a particle released at rest in rising gas ----

TEST(Benchmark, TerminalVelocityOfMFiXDEM06)
{
  // sphere 100 um, 2000 kg/m^3; gas 1.2 kg/m^3, 1.8e-5 Pa s, 0.4 m/s upward; buoyancy included
  const Gas gas{1.2, 1.8e-5 / 1.2};
  const ClusterGeometry g{100.0e-6, 2000.0, 0.0};
  const double fall = 9.80665 * (1.0 - 1.2 / 2000.0), up = 0.4;
  const SchillerNaumannDrag law;
  auto acceleration = [&](double v) {
    return drag_coefficient(law, gas, g.d_p, std::fabs(up - v)) * (up - v) / g.particle_mass() - fall;
  };
  const struct {
    int step;
    double v;
  } published[] = {
      {1000, -0.01255261}, {5000, -0.04078891}, {10000, -0.05263133}, {20000, -0.05701037}, {35000, -0.05739251}};

  // Runge-Kutta of 4th order, steps of 1e-5 s = tau/6000: its error is far below the printed digits
  const double dt = 1.0e-5;
  double v = 0.0, y = 0.0925;
  int next = 0;
  for (int step = 1; step <= 35000; step++) {
    const double k1 = acceleration(v), v2 = v + 0.5 * dt * k1;
    const double k2 = acceleration(v2), v3 = v + 0.5 * dt * k2;
    const double k3 = acceleration(v3), v4 = v + dt * k3;
    const double k4 = acceleration(v4);
    y += dt / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if (step == published[next].step) {
      // eight decimals were published by a code with its own step: two units of the last
      EXPECT_NEAR(v, published[next].v, 2.0e-8) << step;
      next++;
    }
  }
  EXPECT_EQ(next, 5);
  EXPECT_NEAR(y, 0.07472122, 2.0e-8);
}

TEST(Benchmark, ExponentialStepReachesTheSameTerminalVelocity)
{
  // steps of 1 s, many relaxation times (tau ~ 0.05 s): the drag alone takes the particle to the gas in one
  // step
  const Gas gas{1.2, 1.8e-5 / 1.2};
  const ClusterGeometry g{100.0e-6, 2000.0, 0.0};
  double v = 0.0;
  const double b = drag_coefficient(SchillerNaumannDrag(), gas, g.d_p, 0.4), dt = 1.0;
  const double x = dt * b / g.particle_mass();
  EXPECT_GT(x, 10.0);    // an explicit step would leave at ten times the slip
  v += x * exponential_factor(x) * (0.4 - v);
  EXPECT_NEAR(v, 0.4, 0.4 * std::exp(-x) + 4.0 * EPS);    // the closed form, and rounding
}

// ---- held_drag ----

TEST(HeldDrag, FollowsTheSlipOnlyAlongItsDirections)
{
  EXPECT_EQ(held_drag(1.0, 2.0e-6, 3.0, -1.0), 8.0e-6);
  EXPECT_EQ(held_drag(0.0, 2.0e-6, 3.0, -1.0), 0.0);
  EXPECT_EQ(held_drag(1.0, 2.0e-6, 1.5, 1.5), 0.0);
}

// ---- exponential_factor ----

TEST(ExponentialFactor, Limits)
{
  EXPECT_EQ(exponential_factor(0.0), 1.0);
  EXPECT_EQ(exponential_factor(5.0e-324), 1.0);
  // 1 - x/2 + x^2/6: for x = 1e-6 the third term is 2e-13
  EXPECT_NEAR(exponential_factor(1.0e-6), 1.0 - 0.5e-6, 2.0e-13);
  EXPECT_NEAR(exponential_factor(1.0), 0.63212055882855768, 2.0 * EPS);    // 1 - 1/e
  EXPECT_EQ(exponential_factor(1.0e300), 1.0e-300);                        // 1/x
  EXPECT_EQ(exponential_factor(std::numeric_limits<double>::infinity()), 0.0);
}

TEST(ExponentialFactor, NeverOvershoots)
{
  RandomInputs random(10);
  for (int k = 0; k < 100000; k++) {
    const double x = random.log_uniform(1.0e-300, 1.0e300);
    const double f = exponential_factor(x);
    ASSERT_TRUE(f > 0.0 && f <= 1.0) << x;
    ASSERT_LE(f * x, 1.0) << x;    // the share of the slip that a step takes away; 1 is "reaches the gas"
    // closed form of that share, with the digits that expm1 keeps: three roundings
    ASSERT_TRUE(relatively_near(f * x, -std::expm1(-x), 3.0 * EPS)) << x;

    // the step as a fix makes it: force = b f slip, then V += dt/m force
    const double gas = random.uniform(-300.0, 300.0), v = random.uniform(-300.0, 300.0);
    const double after = v + x * f * (gas - v);
    const double rounding = 4.0 * EPS * (std::fabs(gas) + std::fabs(v));
    ASSERT_GE(after, std::min(gas, v) - rounding);
    ASSERT_LE(after, std::max(gas, v) + rounding);
  }
}

TEST(ExponentialFactor, FallsWithTheStep)
{
  double before = 1.0;
  for (double x = 1.0e-8; x < 1.0e8; x *= 1.1) {
    const double f = exponential_factor(x);
    ASSERT_LT(f, before);
    before = f;
  }
}

TEST(ExponentialFactor, ExactForConstantTau)
{
  // any division of a time into steps gives exp(-t/tau); each of up to 1000 steps adds a few roundings
  for (int steps : {1, 2, 10, 1000}) {
    const double x = 3.0 / steps;
    double slip = 1.0;
    for (int k = 0; k < steps; k++) slip -= x * exponential_factor(x) * slip;
    EXPECT_TRUE(relatively_near(slip, std::exp(-3.0), 4.0 * EPS * (steps + 20))) << steps;
  }
}
