// A gas field on a rectilinear grid: the part that is held, interpolation in it linearly along each axis, and
// linearly between two frames in time.

#ifndef CLUSTERDEM_GAS_GRID_H
#define CLUSTERDEM_GAS_GRID_H

#include "grid_axis.h"
#include "vector3.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ClusterDEM {

using GridAxes = std::array<GridAxis, 3>;

// a + w (b - a): exactly a where both are equal
inline double between(double a, double b, double weight)
{
  return a + weight * (b - a);
}

// The planes of each axis that are held. Values of one point lie side by side, points in the order x, y, z.
class GridPart {
 public:
  GridPart() = default;
  GridPart(const GridAxes &axes, const Vec3 &lo, const Vec3 &hi)
  {
    for (int k = 0; k < 3; k++) range_[k] = axes[k].between(lo[k], hi[k]);
  }
  bool operator==(const GridPart &other) const { return range_ == other.range_; }

  const PlaneRange &range(int axis) const { return range_[axis]; }
  std::size_t points() const
  {
    std::size_t n = 1;
    for (const PlaneRange &range : range_) n *= range.count;
    return n;
  }

 private:
  std::array<PlaneRange, 3> range_;
};

// where a position lies in a part: the first of the points around it, and the way to the others
struct GridPlace {
  std::size_t corner = 0;    // all in values
  int axes = 0;              // along which the field is not uniform
  std::array<std::size_t, 3> step = {};
  std::array<double, 3> weight = {};
};

// false where the part does not hold the points around x; `values` of each point lie side by side
inline bool find_place(const GridAxes &axes, const GridPart &part, const double *x, int values, GridPlace &place)
{
  std::size_t step = values;
  place.corner = 0;
  place.axes = 0;
  for (int k = 0; k < 3; k++) {
    if (axes[k].uniform()) continue;
    const AxisPlace at = axes[k].find(x[k]);
    const PlaneRange &range = part.range(k);
    const int plane = axes[k].within(range, at.cell);
    if (plane > range.count - 2) return false;
    place.corner += plane * step;
    place.step[place.axes] = step;
    place.weight[place.axes++] = at.weight;
    step *= range.count;
  }
  return true;
}

// one value, linear along the first AXES of the place's axes
template <int AXES> inline double interpolated(const double *value, const GridPlace &place)
{
  if constexpr (AXES == 0) return *value;
  else
    return between(interpolated<AXES - 1>(value, place),
                   interpolated<AXES - 1>(value + place.step[AXES - 1], place), place.weight[AXES - 1]);
}

template <int AXES>
inline void interpolate_all(const double *values, const GridPlace &place, int n, double *result)
{
  for (int q = 0; q < n; q++) result[q] = interpolated<AXES>(values + place.corner + q, place);
}

// the n values of a point at a place
inline void interpolate(const double *values, const GridPlace &place, int n, double *result)
{
  switch (place.axes) {
    case 0:
      return interpolate_all<0>(values, place, n, result);
    case 1:
      return interpolate_all<1>(values, place, n, result);
    case 2:
      return interpolate_all<2>(values, place, n, result);
    default:
      return interpolate_all<3>(values, place, n, result);
  }
}

// ---- time

// the frame before a time, the one after it, and the share of the way between them
struct FramePair {
  int before = 0, after = 0;
  double weight = 0.0;
};

// Frames in strictly ascending order of their times. Before the first and after the last these two hold; with a period
// > 0 the series repeats, and from the last frame to the first of the next period it goes on linearly.
inline FramePair frames_at(const std::vector<double> &times, double period, double t)
{
  const int last = static_cast<int>(times.size()) - 1;
  if (last == 0) return {0, 0, 0.0};
  t = Fold{times.front(), period}(t);
  if (!(t > times.front())) return {0, 0, 0.0};
  if (t >= times.back()) {
    const double gap = times.front() + period - times.back();
    if (!(gap > 0.0)) return {last, last, 0.0};
    return {last, 0, std::fmin((t - times.back()) / gap, 1.0)};
  }
  const int k = static_cast<int>(std::upper_bound(times.begin(), times.end(), t) - times.begin());
  return {k - 1, k, (t - times[k - 1]) / (times[k] - times[k - 1])};
}

}    // namespace ClusterDEM
#endif
