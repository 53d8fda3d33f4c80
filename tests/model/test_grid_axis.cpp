// An axis of a rectilinear grid: between which planes a position lies, folding, and the planes that a rank asks for.

#include "model_testing.h"

#include "model/grid_axis.h"

using namespace ClusterDEM;

namespace {

// planes with gaps over several decades, from -1 to about 1
std::vector<double> uneven(RandomInputs &random, int n)
{
  std::vector<double> planes = {random.uniform(-1.0, 0.0)};
  while (static_cast<int>(planes.size()) < n) planes.push_back(planes.back() + random.log_uniform(1.0e-6, 0.1));
  return planes;
}

std::vector<double> even(double first, double spacing, int n)
{
  std::vector<double> planes;
  for (int k = 0; k < n; k++) planes.push_back(first + k * spacing);
  return planes;
}

}    // namespace

TEST(GridAxis, FindsTheCellAsASearchDoes)
{
  RandomInputs random(70);
  for (int trial = 0; trial < 300; trial++) {
    const int n = random.integer(2, 200);
    const auto planes = trial % 3 ? uneven(random, n)
                                  : even(random.uniform(-1.0, 1.0), random.log_uniform(1e-6, 1.0), n);
    const GridAxis axis(planes, Fold());
    for (int k = 0; k < 100; k++) {
      const double x = random.uniform(planes.front(), planes.back());
      const AxisPlace at = axis.find(x);
      ASSERT_GE(at.cell, 0);
      ASSERT_LT(at.cell, n - 1);
      // a position within rounding of a plane may be counted to either side of it
      ASSERT_GE(at.weight, -1.0e-9);
      ASSERT_LE(at.weight, 1.0 + 1.0e-9);
      const double gap = planes[at.cell + 1] - planes[at.cell];
      ASSERT_NEAR(planes[at.cell] + at.weight * gap, x, 4.0 * EPS * 200.0);
    }
    for (int k = 0; k < n - 1; k++) {    // the planes themselves
      const AxisPlace at = axis.find(planes[k]);
      ASSERT_EQ(at.cell, k);
      ASSERT_EQ(at.weight, 0.0);
    }
  }
}

TEST(GridAxis, HoldsTheEndsBeyondThem)
{
  const GridAxis axis({1.0, 2.0, 4.0}, Fold());
  for (const double x : {-1.0e300, -5.0, 1.0}) {
    EXPECT_EQ(axis.find(x).cell, 0);
    EXPECT_EQ(axis.find(x).weight, 0.0);
  }
  for (const double x : {4.0, 4.5, 1e300}) {
    EXPECT_EQ(axis.find(x).cell, 1);
    EXPECT_EQ(axis.find(x).weight, 1.0);
  }
  EXPECT_EQ(axis.find(NAN).cell, 0);    // whatever: but a cell that there is
}

TEST(GridAxis, OnePlaneIsUniform)
{
  for (const GridAxis &axis : {GridAxis({0.5}, Fold()), GridAxis::periodic({0.5}, 3.0), GridAxis()}) {
    EXPECT_TRUE(axis.uniform());
    EXPECT_EQ(axis.find(77.0).cell, 0);
    EXPECT_EQ(axis.find(77.0).weight, 0.0);
    EXPECT_EQ(axis.between(-1e9, 1e9), (PlaneRange{0, 1}));
  }
}

TEST(GridAxis, ClampedPositionsAreFoldedIntoAPeriodicBoxFirst)
{
  const GridAxis axis({1.0, 2.0, 3.0}, Fold{0.0, 4.0});
  EXPECT_EQ(axis.find(4.5).cell, 0);    // 0.5: below the first
  EXPECT_EQ(axis.find(4.5).weight, 0.0);
  EXPECT_EQ(axis.find(-0.5).cell, 1);    // 3.5: above the last
  EXPECT_EQ(axis.find(-0.5).weight, 1.0);
}

TEST(GridAxis, PeriodicGoesOnFromTheLastPlaneToTheFirst)
{
  const GridAxis axis = GridAxis::periodic({0.5, 1.5, 2.5}, 3.0);    // values in cell centres of a box from 0 to 3
  EXPECT_EQ(axis.planes(), 3);
  EXPECT_FALSE(axis.closed());
  EXPECT_EQ(axis.find(2.75).cell, 2);
  EXPECT_DOUBLE_EQ(axis.find(2.75).weight, 0.25);
  EXPECT_EQ(axis.find(0.25).cell, 2);
  EXPECT_DOUBLE_EQ(axis.find(0.25).weight, 0.75);
  EXPECT_EQ(axis.find(-0.25).cell, 2);
  EXPECT_EQ(axis.find(3.0 + 0.75).cell, 0);
  EXPECT_DOUBLE_EQ(axis.find(3.0 + 0.75).weight, 0.25);
}

TEST(GridAxis, ALastPlaneOnePeriodOnIsTheFirst)
{
  const double rounded = 3.0 * (1.0 + 3.0e-8);    // as a file of single precision has it
  const GridAxis axis = GridAxis::periodic({0.0, 1.0, 2.0, rounded}, 3.0);
  EXPECT_TRUE(axis.closed());
  EXPECT_EQ(axis.planes(), 3);
  EXPECT_EQ(axis.find(2.5).cell, 2);
  EXPECT_DOUBLE_EQ(axis.find(2.5).weight, 0.5);
}

// every position of the interval finds both planes of its cell in the range, and the range is no larger than needed
TEST(GridAxis, RangeHoldsWhatAnIntervalAsksFor)
{
  RandomInputs random(71);
  for (int trial = 0; trial < 2000; trial++) {
    const int n = random.integer(2, 40);
    const auto planes = uneven(random, n);
    const double length = (planes.back() - planes.front()) * random.uniform(1.01, 2.0);
    const int kind = random.integer(0, 2);
    const GridAxis axis = kind == 0 ? GridAxis(planes, Fold())
        : kind == 1                 ? GridAxis(planes, Fold{planes.front() - 0.3 * length, 1.6 * length})
                                    : GridAxis::periodic(planes, length);
    const double lo = random.uniform(-3.0, 2.0), hi = lo + random.log_uniform(1.0e-4, 3.0);
    const PlaneRange range = axis.between(lo, hi);
    ASSERT_GE(range.count, 2);
    ASSERT_LE(range.count, kind == 2 ? n + 1 : n);
    for (int k = 0; k <= 100; k++) {
      const double x = std::min(hi, lo + k * (hi - lo) / 100.0);
      const int cell = axis.find(x).cell, local = axis.within(range, cell);
      ASSERT_GE(local, 0);
      ASSERT_LE(local, range.count - 2) << trial << " " << x;
      ASSERT_EQ((range.first + local) % axis.planes(), cell);
    }
  }
}

TEST(GridAxis, RangeIsNoLargerThanNeeded)
{
  const GridAxis clamped(even(0.0, 1.0, 11), Fold()), periodic = GridAxis::periodic(even(0.0, 1.0, 10), 10.0);
  EXPECT_EQ(clamped.between(2.5, 4.5), (PlaneRange{2, 4}));
  EXPECT_EQ(clamped.between(-3.0, 0.5), (PlaneRange{0, 2}));
  EXPECT_EQ(periodic.between(8.5, 11.5), (PlaneRange{8, 5}));    // 8 9 0 1 2
  EXPECT_EQ(periodic.between(-0.5, 0.5), (PlaneRange{9, 3}));
  EXPECT_EQ(periodic.between(0.2, 9.9), (PlaneRange{0, 11}));
  EXPECT_EQ(periodic.between(0.2, 0.8), (PlaneRange{0, 2}));
  EXPECT_EQ(periodic.between(0.5, 10.3), (PlaneRange{0, 11}));
}
