// The prescribed gas: profile, cells, periods, and the counter-based fluctuation.

#include "model_testing.h"

#include "model/gas_field.h"

#include <array>
#include <set>

using namespace ClusterDEM;

// ---- profile ----

TEST(GasProfile, LinearVelocityIsReproduced)
{
  // whatever the nodes, a linear profile comes back: values up to 300, a weighted sum of two of them rounds a
  // few times
  RandomInputs random(40);
  for (int trial = 0; trial < 500; trial++) {
    GasProfile profile;
    const Vec3 at_zero = random.vector(100.0), slope = random.vector(100.0);
    double s = random.uniform(-1.0, 0.0);
    for (int node = random.integer(2, 30); node > 0; node--) {
      profile.s.push_back(s);
      profile.u.push_back(at_zero + s * slope);
      s += random.log_uniform(1.0e-6, 0.1);    // narrow and wide gaps
    }
    for (int k = 0; k < 50; k++) {
      const double x = random.uniform(profile.s.front(), profile.s.back());
      const Vec3 u = profile.at(x), expected = at_zero + x * slope;
      // the weight inherits the rounding of s relative to a gap of 1e-6 at least, times a rise over that gap:
      // the product is EPS |s| |slope| again; |s| < 4, |slope| <= 100, |u| <= 500
      for (int c = 0; c < 3; c++) ASSERT_NEAR(u[c], expected[c], 8.0 * EPS * 500.0);
    }
  }
}

TEST(GasProfile, NodesAreExact)
{
  const GasProfile profile{{-1.0, 0.1, 0.3, 2.0},
                           {{1.0, 2.0, 3.0}, {-4.0, 5.0, 0.7}, {0.1, 0.2, 0.3}, {9.0, 8.0, 7.0}}};
  for (std::size_t k = 0; k < profile.s.size(); k++) EXPECT_EQ(profile.at(profile.s[k]), profile.u[k]) << k;
}

TEST(GasProfile, ByHand)
{
  // a quarter of the way between two nodes in the second gap
  const GasProfile profile{{0.0, 1.0, 3.0}, {{0.0, 0.0, 0.0}, {4.0, 0.0, 8.0}, {8.0, 4.0, 0.0}}};
  EXPECT_EQ(profile.at(1.5), (Vec3{5.0, 1.0, 6.0}));
  EXPECT_EQ(profile.at(0.5), (Vec3{2.0, 0.0, 4.0}));
}

TEST(GasProfile, ConstantBeyondItsEnds)
{
  const GasProfile profile{{0.0, 1.0}, {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}};
  EXPECT_EQ(profile.at(-1.0e300), profile.u.front());
  EXPECT_EQ(profile.at(-1.0e-300), profile.u.front());
  EXPECT_EQ(profile.at(1.0 + EPS), profile.u.back());
  EXPECT_EQ(profile.at(1.0e300), profile.u.back());
  const GasProfile uniform{{0.5}, {{1.0, 2.0, 3.0}}};    // a single node
  for (double x : {-1.0, 0.5, 2.0}) EXPECT_EQ(uniform.at(x), uniform.u.front());
}

// ---- period ----

TEST(PeriodIndex, TimeSummedUpInStepsFallsIntoTheRightPeriod)
{
  // t = k period, reached by summing dt, still is period k - 1; integers of nanoseconds tell the truth.
  // Summing drifts by up to steps^2 EPS/2 of dt, which must stay below the 1e-6 of a period:
  // where period = dt only the first 50000 steps are summed (3e-7), elsewhere all 300000
  const struct {
    std::int64_t dt, period;    // ns
    std::int64_t summed_steps;
  } cases[] = {{1000, 5000000, 300000}, {2000, 5000000, 300000}, {4000, 5000000, 300000}, {11000, 5000000, 300000},
               {333, 100000, 300000},   {1000, 3000, 50000},     {1000, 1000, 50000}};
  for (const auto &c : cases) {
    const double dt = c.dt * 1.0e-9, period = c.period * 1.0e-9;
    double summed = 0.0;
    for (std::int64_t step = 0; step <= 300000; step++, summed += dt) {
      const std::int64_t truth = step == 0 ? 0 : (step * c.dt - 1) / c.period;
      if (step <= c.summed_steps) {
        ASSERT_EQ(period_index(summed, period), truth) << "step " << step << " of " << c.dt << " ns";
      }
      ASSERT_EQ(period_index(step * dt, period), truth) << "step " << step << " of " << c.dt << " ns";
      // as an engine keeps time: the time of an earlier step (a change of dt, a restart) plus the steps since
      const std::int64_t since = step / 3;
      ASSERT_EQ(period_index((step - since) * dt + since * dt, period), truth);
    }
  }
}

TEST(PeriodIndex, RoundingRule)
{
  // within 1e-6 of a period above its end still counts to it, and no more than that
  for (std::int64_t k : {1, 2, 10, 1000000}) {
    EXPECT_EQ(period_index(0.005 * k, 0.005), k - 1);
    EXPECT_EQ(period_index(0.005 * (k + 0.9e-6), 0.005), k - 1);
    EXPECT_EQ(period_index(0.005 * (k + 1.1e-6), 0.005), k);
    EXPECT_EQ(period_index(0.005 * (k + 0.5), 0.005), k);
  }
  EXPECT_EQ(period_index(0.0, 0.005), 0);
  EXPECT_EQ(period_index(-0.001, 0.005), 0);    // nothing comes before the first
}

TEST(PeriodIndex, ManyPeriods)
{
  // beyond the range of a 32-bit integer
  EXPECT_EQ(period_index(1.0e10 + 0.5, 1.0), 10000000000);
  // and of a 64-bit one, up to infinity
  for (double period : {1.0e-25, 1.0e-300, 4.9e-324}) EXPECT_EQ(period_index(1.0e-6, period), INT64_MAX);
}

TEST(PeriodIndex, FrozenIsAlwaysZero)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (double period : {0.0, -1.0, -0.0, nan, inf})
    for (double t : {0.0, 1.0e-9, 0.05, 1.0e300 * 0.0, 1.0e9})
      EXPECT_EQ(period_index(t, period), 0) << period << " " << t;
}

// ---- cell ----

TEST(CellIndex, ByHand)
{
  EXPECT_EQ(cell_index((0.0) / 0.3, 30), 0);
  EXPECT_EQ(cell_index((0.299999) / 0.3, 30), 29);
  EXPECT_EQ(cell_index((0.155) / 0.3, 30), 15);
  EXPECT_EQ(cell_index(0.375, 8), 3);
  EXPECT_EQ(cell_index((0.1) / 0.3, 1), 0);
}

TEST(CellIndex, WrapsAtBothEnds)
{
  EXPECT_EQ(cell_index((0.3) / 0.3, 30), 0);    // hi is lo again
  EXPECT_EQ(cell_index((-0.001) / 0.3, 30), 29);
  EXPECT_EQ(cell_index((0.305) / 0.3, 30), 0);
  // so little below lo that the wrapped share rounds to 1: the last cell, not one beyond it
  EXPECT_EQ(cell_index((-1.0e-20) / 0.3, 30), 29);
  EXPECT_EQ(cell_index((-5.0e-324) / 0.3, 30), 29);
  EXPECT_EQ(cell_index((std::nextafter(0.3, 0.0)) / 0.3, 30), 29);
}

TEST(CellIndex, EveryImageOfAPointIsInTheSameCell)
{
  RandomInputs random(41);
  for (int k = 0; k < 50000; k++) {
    const int n = random.integer(1, 1000), cell = random.integer(0, n - 1), image = random.integer(-1000, 1000);
    const double lo = random.uniform(-10.0, 10.0), length = random.log_uniform(1.0e-3, 10.0);
    // off the cell's faces by 0.01 of a cell; coordinates of up to 1e4 in a box of 1e-3 round by 2e-9 of the
    // box, which is 2e-6 of the smallest cell
    const double share = (cell + random.uniform(0.01, 0.99)) / n;
    ASSERT_EQ(cell_index((lo + share * length + image * length - lo) * (1.0 / length), n), cell);
  }
}

TEST(CellIndex, AlwaysACell)
{
  RandomInputs random(42);
  for (int k = 0; k < 100000; k++) {
    const int n = random.integer(1, 2000000000);
    const double lo = random.uniform(-1.0, 1.0), length = random.log_uniform(1.0e-9, 1.0e3);
    const double x = random.vector(1.0e9)[0];
    const int cell = cell_index((x - lo) / length, n);
    ASSERT_GE(cell, 0) << x;
    ASSERT_LT(cell, n) << x;
  }
}

// ---- fluctuation ----

TEST(Fluctuation, KnownAnswerOfPhilox)
{
  // philox4x64-10 of counter 0 and key 0, from Random123's own table of known answers (kat_vectors)
  const std::uint64_t answer[] = {0x16554d9eca36314cULL, 0xdb20fe9d672d0fdcULL, 0xd7e772cee186176bULL};
  const Vec3 u = uniform_fluctuation(0, 0, 0, 0, 0);
  // 64 bits over the interval -1 to 1; the number keeps 53 of them: 2 units of 2^-52
  for (int k = 0; k < 3; k++)
    EXPECT_NEAR(u[k], static_cast<double>(answer[k]) * 0x1p-63 - 1.0, 2.0 * 0x1p-52) << k;
}

TEST(Fluctuation, PureFunctionOfItsKey)
{
  // the same keys in another order, after other calls: the same bits
  RandomInputs random(43);
  std::vector<std::array<std::int64_t, 3>> keys(2000);
  for (auto &key : keys) key = {random.integer(-1000, 1000000), random.integer(0, 100), random.integer(0, 100)};
  std::vector<Vec3> own, cell;
  for (const auto &k : keys) {
    own.push_back(own_fluctuation(12345, k[0], k[1], k[2]));
    cell.push_back(cell_fluctuation(12345, k[0], k[2]));
  }
  for (std::size_t k = keys.size(); k-- > 0;) {
    ASSERT_EQ(cell_fluctuation(12345, keys[k][0], keys[k][2]), cell[k]);
    ASSERT_EQ(own_fluctuation(12345, keys[k][0], keys[k][1], keys[k][2]), own[k]);
  }
}

TEST(Fluctuation, EveryPartOfTheKeyMatters)
{
  // 2 streams x 5 seeds x 9 x 5 x 5 keys; two equal first components of 53 bits would be a chance of 1e-9
  std::set<double> seen;
  int drawn = 0;
  for (std::uint64_t seed : {0ULL, 1ULL, 2ULL, 12345ULL, ~0ULL})
    for (std::int64_t a = -4; a <= 4; a++)
      for (std::int64_t period = -1; period <= 3; period++) {
        seen.insert(cell_fluctuation(seed, a, period)[0]);
        drawn++;
        for (std::int64_t draw = 0; draw < 5; draw++) {
          seen.insert(own_fluctuation(seed, a, draw, period)[0]);
          drawn++;
        }
      }
  EXPECT_EQ(static_cast<int>(seen.size()), drawn);
  // large tags are not cut to 32 bits
  EXPECT_NE(own_fluctuation(1, 5, 0, 0), own_fluctuation(1, 5 + (1LL << 32), 0, 0));
}

TEST(Fluctuation, UniformInMinusOneToOne)
{
  // N numbers of mean 0, variance 1/3 (standard deviation of the mean 0.577/sqrt N), mean square 1/3
  // (its variance 4/45), and as many in each of 64 bins (chi^2 of 63 degrees: 63 +- 11.2). Five standard
  // deviations each; a fixed key, so this passes or fails always.
  const int N = 300000, BINS = 64;
  double sum[3] = {}, square[3] = {}, product[3] = {}, in_a_row = 0.0, last = 0.0;
  std::vector<int> bins(BINS, 0);
  for (int k = 0; k < N; k++) {
    const Vec3 u = cell_fluctuation(7, k % 900, k / 900);    // cells and periods as in a run
    for (int c = 0; c < 3; c++) {
      ASSERT_GE(u[c], -1.0);
      ASSERT_LE(u[c], 1.0);
      sum[c] += u[c];
      square[c] += u[c] * u[c];
      product[c] += u[c] * u[(c + 1) % 3];
    }
    in_a_row += u[2] * last;
    last = u[2];
    bins[std::min(BINS - 1, static_cast<int>((u[0] + 1.0) / 2.0 * BINS))]++;
  }
  const double root = std::sqrt(static_cast<double>(N));
  for (int c = 0; c < 3; c++) {
    EXPECT_NEAR(sum[c] / N, 0.0, 5.0 * std::sqrt(1.0 / 3.0) / root);
    EXPECT_NEAR(square[c] / N, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0) / root);
    EXPECT_NEAR(product[c] / N, 0.0, 5.0 / 3.0 / root);    // independent components: variance 1/9
  }
  EXPECT_NEAR(in_a_row / N, 0.0, 5.0 / 3.0 / root);    // independent neighbours
  double chi2 = 0.0;
  const double expected = static_cast<double>(N) / BINS;
  for (int count : bins) chi2 += (count - expected) * (count - expected) / expected;
  EXPECT_NEAR(chi2, BINS - 1, 5.0 * std::sqrt(2.0 * (BINS - 1)));
}

TEST(Fluctuation, PeriodsSeedsAndDrawsAreUncorrelated)
{
  // products of two independent numbers: mean 0, standard deviation 1/3; five of them
  const int N = 100000;
  double periods = 0.0, seeds = 0.0, draws = 0.0, streams = 0.0;
  for (int k = 0; k < N; k++) {
    periods += cell_fluctuation(7, k, 0)[0] * cell_fluctuation(7, k, 1)[0];
    seeds += cell_fluctuation(7, k, 0)[0] * cell_fluctuation(8, k, 0)[0];
    draws += own_fluctuation(7, k, 0, 0)[0] * own_fluctuation(7, k, 1, 0)[0];
    streams += cell_fluctuation(7, k, 0)[0] * own_fluctuation(7, k, 0, 0)[0];
  }
  for (double sum : {periods, seeds, draws, streams})
    EXPECT_NEAR(sum / N, 0.0, 5.0 / 3.0 / std::sqrt(static_cast<double>(N)));
}
