// The prescribed gas: a mean velocity tabulated along one axis, and a fluctuation drawn from
// counter-based random numbers, so that it depends on neither the ranks nor the order of clusters.

#ifndef CLUSTERDEM_GAS_FIELD_H
#define CLUSTERDEM_GAS_FIELD_H

#include "vector3.h"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ClusterDEM {

// Mean velocity along one axis, piecewise linear between the nodes, constant beyond the ends.
// Nodes in strictly ascending order.
struct GasProfile {
  std::vector<double> s;
  std::vector<Vec3> u;

  Vec3 at(double position) const
  {
    if (!(position > s.front())) return u.front();
    if (position >= s.back()) return u.back();
    const std::size_t k = std::upper_bound(s.begin(), s.end(), position) - s.begin();
    const double w = (position - s[k - 1]) / (s[k] - s[k - 1]);
    return (1.0 - w) * u[k - 1] + w * u[k];
  }
};

// Index of the period that the time t lies in. Rounding rule: period k lasts from k * period, left out,
// to (k + 1) * period, included, so that what is seen at the end of a period is the state that this
// period led to; t = 0 belongs to period 0. A time within 1e-6 of a period above an end counts as that
// end, so that times summed up in steps of dt fall where they should. period <= 0 means frozen: always 0.
// Periods beyond the range of the numbers count as one.
inline std::int64_t period_index(double t, double period)
{
  if (!(period > 0.0)) return 0;
  const double k = std::ceil(t / period - 1.0e-6) - 1.0;
  if (k >= 0x1p63) return INT64_MAX;
  return k > 0.0 ? static_cast<std::int64_t>(k) : 0;
}

// Cell of n along one axis of the box, `share` being the position from its lower side over its length,
// wrapped where a periodic box has not taken it in yet.
inline int cell_index(double share, int n)
{
  if (n == 1) return 0;
  if (share < 0.0 || share >= 1.0) share -= std::floor(share);
  const int k = static_cast<int>(share * n);
  return std::min(k, n - 1);
}

// Three independent numbers uniform in [-1, 1], a pure function of the key (Philox 4x64-10).
inline Vec3 uniform_fluctuation(std::uint64_t seed, std::uint64_t stream, std::int64_t a, std::int64_t b,
                                std::int64_t period)
{
  r123::Philox4x64::key_type key = {{seed, stream}};
  r123::Philox4x64::ctr_type counter = {
      {static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(period), 0}};
  const auto random = r123::Philox4x64()(counter, key);
  Vec3 u;
  for (int k = 0; k < 3; k++)
    u[k] = static_cast<double>(random[k] >> 11) * (2.0 / 9007199254740991.0) - 1.0;    // 53 bits
  return u;
}

// keyed by gas cell, or by (cluster tag, draw number): two streams of one seed
inline Vec3 cell_fluctuation(std::uint64_t seed, std::int64_t cell, std::int64_t period)
{
  return uniform_fluctuation(seed, 1, cell, 0, period);
}
inline Vec3 own_fluctuation(std::uint64_t seed, std::int64_t tag, std::int64_t draw, std::int64_t period)
{
  return uniform_fluctuation(seed, 2, tag, draw, period);
}

}    // namespace ClusterDEM
#endif
