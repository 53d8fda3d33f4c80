// Interpolation of a gas field: exact where it is linear, of the second order where it is smooth, in space and time.

#include "model_testing.h"

#include "model/gas_grid.h"

#include <functional>

using namespace ClusterDEM;

namespace {

using Function = std::function<Vec3(const Vec3 &)>;

// the values that a part holds, as a reader would fill them in
std::vector<double> filled(const GridAxes &axes, const GridPart &part, const Function &u)
{
  std::vector<double> values;
  for (int c = 0; c < part.range(2).count; c++)
    for (int b = 0; b < part.range(1).count; b++)
      for (int a = 0; a < part.range(0).count; a++) {
        const int local[3] = {a, b, c};
        Vec3 x;
        for (int k = 0; k < 3; k++) x[k] = axes[k].plane((part.range(k).first + local[k]) % axes[k].planes());
        for (const double v : u(x)) values.push_back(v);
      }
  return values;
}

std::vector<double> planes(RandomInputs &random, int n)
{
  std::vector<double> x = {0.0};
  while (static_cast<int>(x.size()) < n) x.push_back(x.back() + random.log_uniform(1.0e-3, 0.1));
  return x;
}

}    // namespace

TEST(GasGrid, LinearFieldsAreExact)
{
  RandomInputs random(80);
  for (int trial = 0; trial < 200; trial++) {
    GridAxes axes;
    for (auto &axis : axes)
      if (random.integer(0, 3)) axis = GridAxis(planes(random, random.integer(2, 12)), Fold());
    const Vec3 at_zero = random.vector(10.0),
               slopes[3] = {random.vector(10.0), random.vector(10.0), random.vector(10.0)};
    const Function u = [&](const Vec3 &x) {
      Vec3 sum = at_zero;
      for (int k = 0; k < 3; k++)
        if (!axes[k].uniform()) sum = sum + x[k] * slopes[k];
      return sum;
    };
    Vec3 lo, hi;
    for (int k = 0; k < 3; k++) {
      const double end = axes[k].plane(axes[k].planes() - 1);
      lo[k] = random.uniform(0.0, 0.5 * end);
      hi[k] = random.uniform(lo[k], end);
    }
    const GridPart part(axes, lo, hi);
    const auto values = filled(axes, part, u);
    for (int m = 0; m < 50; m++) {
      Vec3 x, result;
      for (int k = 0; k < 3; k++) x[k] = random.uniform(lo[k], hi[k]);
      GridPlace place;
      ASSERT_TRUE(find_place(axes, part, x.data(), 3, place));
      interpolate(values.data(), place, 3, result.data());
      // |u| < 10 + 3 * 1.2 * 10; the weight inherits the rounding of x relative to a gap of 1e-3 at least, times the rise
      // over that gap: EPS |x| |slope| again; a dozen roundings
      for (int c = 0; c < 3; c++) ASSERT_NEAR(result[c], u(x)[c], 16.0 * EPS * 46.0);
    }
  }
}

TEST(GasGrid, OneValueEverywhereComesBackBitForBit)
{
  RandomInputs random(81);
  GridAxes axes;
  for (auto &axis : axes) axis = GridAxis::periodic(planes(random, 7), 1.0);
  const GridPart part(axes, {0, 0, 0}, {1, 1, 1});
  const auto values = filled(axes, part, [](const Vec3 &) { return Vec3{0.1, -0.7, 1.0 / 3.0}; });
  for (int m = 0; m < 500; m++) {
    const double x[3] = {random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2)};
    GridPlace place;
    Vec3 result;
    ASSERT_TRUE(find_place(axes, part, x, 3, place));
    interpolate(values.data(), place, 3, result.data());
    ASSERT_EQ(result, (Vec3{0.1, -0.7, 1.0 / 3.0}));
  }
}

TEST(GasGrid, PartsGiveWhatTheWholeGives)
{
  RandomInputs random(82);
  const Function u = [](const Vec3 &x) { return Vec3{std::sin(7 * x[0] + x[2]), x[1] * x[2], std::exp(x[0])}; };
  for (int trial = 0; trial < 200; trial++) {
    GridAxes axes = {GridAxis::periodic(planes(random, 9), 1.0), GridAxis(planes(random, 5), Fold()),
                     GridAxis::periodic(planes(random, 8), 1.0)};
    const Vec3 lo = {random.uniform(-0.5, 1), random.uniform(-0.1, 0.2), random.uniform(-0.5, 1)};
    const Vec3 hi = {lo[0] + random.uniform(0, 0.6), lo[1] + random.uniform(0, 0.2),
                     lo[2] + random.uniform(0, 0.6)};
    const GridPart part(axes, lo, hi), whole(axes, {0, 0, 0}, {1, 1, 1});
    const auto some = filled(axes, part, u), all = filled(axes, whole, u);
    for (int m = 0; m < 50; m++) {
      Vec3 x, a, b;
      for (int k = 0; k < 3; k++) x[k] = random.uniform(lo[k], hi[k]);
      GridPlace place;
      ASSERT_TRUE(find_place(axes, part, x.data(), 3, place));
      interpolate(some.data(), place, 3, a.data());
      ASSERT_TRUE(find_place(axes, whole, x.data(), 3, place));
      interpolate(all.data(), place, 3, b.data());
      ASSERT_EQ(a, b);
    }
  }
}

TEST(GasGrid, OutsideOfItsPartSaysSo)
{
  const GridAxes axes = {GridAxis({0, 1, 2, 3, 4}, Fold()), GridAxis(), GridAxis::periodic({0, 1, 2, 3}, 4.0)};
  const GridPart part(axes, {1.2, 0, 3.2}, {2.7, 0, 3.9});
  const auto holds = [&](double x, double z) {
    GridPlace place;
    const double at[3] = {x, 55.0, z};
    return find_place(axes, part, at, 3, place);
  };
  EXPECT_TRUE(holds(1.0, 3.0));
  EXPECT_TRUE(holds(2.9, 3.9));
  EXPECT_TRUE(holds(2.0, -0.5));    // 3.5
  EXPECT_FALSE(holds(0.9, 3.5));
  EXPECT_FALSE(holds(3.1, 3.5));
  EXPECT_FALSE(holds(2.0, 2.9));
  EXPECT_FALSE(holds(2.0, 0.1));
  EXPECT_FALSE(holds(2.0, 4.1));
}

// Taylor-Green vortices on a periodic grid: halving the spacing divides the largest error by four
TEST(GasGrid, SmoothFieldsToTheSecondOrder)
{
  const double k = 2.0 * 3.14159265358979323846;
  const Function u = [&](const Vec3 &x) {
    return Vec3{std::sin(k * x[0]) * std::cos(k * x[2]), 0.0, -std::cos(k * x[0]) * std::sin(k * x[2])};
  };
  double before = 0.0;
  for (const int n : {16, 32, 64, 128, 256}) {
    std::vector<double> x;
    for (int m = 0; m < n; m++) x.push_back(static_cast<double>(m) / n);
    const GridAxes axes = {GridAxis::periodic(x, 1.0), GridAxis(), GridAxis::periodic(x, 1.0)};
    const GridPart part(axes, {0, 0, 0}, {1, 1, 1});
    const auto values = filled(axes, part, u);
    RandomInputs random(83);
    double worst = 0.0;
    for (int m = 0; m < 20000; m++) {
      const Vec3 at = {random.uniform(0, 1), 0.0, random.uniform(0, 1)};
      GridPlace place;
      Vec3 result;
      ASSERT_TRUE(find_place(axes, part, at.data(), 3, place));
      interpolate(values.data(), place, 3, result.data());
      worst = std::max(worst, norm(result - u(at)));
    }
    // the error of linear interpolation along two axes is at most 2 h^2/8 k^2
    EXPECT_LT(worst, k * k / (4.0 * n * n));
    // at the coarsest the next term of the series, (k h)^2/12 = 1 %, is seen; points drawn miss the worst place by 2 %
    if (before > 0.0) { EXPECT_NEAR(std::log2(before / worst), 2.0, 0.1) << n; }
    before = worst;
  }
}

// ---- time

TEST(FrameTimes, EndsHold)
{
  const std::vector<double> times = {1.0, 2.0, 4.0};
  for (const double t : {-3.0, 0.0, 1.0}) {
    const FramePair at = frames_at(times, 0.0, t);
    EXPECT_EQ(at.before, 0);
    EXPECT_EQ(at.weight, 0.0);
  }
  for (const double t : {4.0, 5.0, 1e9}) {
    const FramePair at = frames_at(times, 0.0, t);
    EXPECT_EQ(at.before, 2);
    EXPECT_EQ(at.after, 2);
  }
}

TEST(FrameTimes, LinearBetweenFrames)
{
  RandomInputs random(84);
  for (int trial = 0; trial < 500; trial++) {
    const auto times = planes(random, random.integer(2, 20));
    const double t = random.uniform(times.front(), times.back());
    const FramePair at = frames_at(times, 0.0, t);
    ASSERT_EQ(at.after, at.before + 1);
    ASSERT_NEAR(between(times[at.before], times[at.after], at.weight), t, 8.0 * EPS);
  }
}

TEST(FrameTimes, LoopRepeatsTheSeries)
{
  const std::vector<double> times = {1.0, 2.0, 4.0};
  const double period = 5.0;    // from the frame at 4 to the next first frame at 6
  for (const double turn : {-10.0, 0.0, 5.0, 50.0}) {
    FramePair at = frames_at(times, period, turn + 3.5);
    EXPECT_EQ(at.before, 1);
    EXPECT_EQ(at.after, 2);
    EXPECT_DOUBLE_EQ(at.weight, 0.75);
    at = frames_at(times, period, turn + 5.5);
    EXPECT_EQ(at.before, 2);
    EXPECT_EQ(at.after, 0);
    EXPECT_DOUBLE_EQ(at.weight, 0.75);
  }
}

TEST(FrameTimes, LoopOfExactlyTheSeriesJumpsFromItsLastToItsFirst)
{
  const std::vector<double> times = {0.0, 1.0, 2.0};
  EXPECT_EQ(frames_at(times, 2.0, 1.5).before, 1);
  EXPECT_EQ(frames_at(times, 2.0, 2.0).before, 0);
  EXPECT_EQ(frames_at(times, 2.0, 2.5).before, 0);
  EXPECT_DOUBLE_EQ(frames_at(times, 2.0, 2.5).weight, 0.5);
}
