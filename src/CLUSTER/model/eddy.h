// How long a gust lasts for a cluster: the eddy's own lifetime, or the time in which the cluster crosses it.
// Eddy-interaction model of Gosman & Ioannides (1983), in the form of OpenFOAM's StochasticDispersionRAS: the shorter of both.

#ifndef CLUSTERDEM_EDDY_H
#define CLUSTERDEM_EDDY_H

#include "gas_field.h"
#include "vector3.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ClusterDEM {

// the turbulence where a cluster is
struct EddyHere {
  double period;     // of the eddy itself, c k/eps [time]
  double size;       // [length]; infinite: no cluster leaves its eddy
  Vec3 slip;         // mean gas velocity less the cluster's velocity
  Vec3 amplitude;    // of the fluctuation, by component [velocity]

  // with a gust of these factors on the amplitude
  double lifetime(const Vec3 &factors) const
  {
    Vec3 relative = slip;
    for (int k = 0; k < 3; k++) relative[k] += amplitude[k] * factors[k];
    const double speed = norm(relative);
    return speed * period > size ? size / speed : period;
  }
};

// When the gusts of a cluster end: the number of the present one, and the moment at which it ends.
struct EddyClock {
  double ends = 0.0;
  std::int64_t gust = 0;
};

// How lifetimes are spread: all alike, or as -ln(r), r uniform in (0, 1], which makes the gusts a Poisson process.
enum class Lifetimes { FIXED, EXPONENTIAL };

// Shares of a lifetime, pure functions of the gust's key: of a whole one, and of what is left of one that began before
// anybody looked, which is uniform for lifetimes that are all alike.
inline double uniform_share(std::uint64_t seed, std::uint64_t stream, std::int64_t a, std::int64_t b,
                            std::int64_t gust)
{
  return 0.5 * (1.0 + uniform_fluctuation(seed, stream, a, b, gust)[0]);    // in [0, 1]
}
inline double lifetime_share(Lifetimes kind, std::uint64_t seed, std::int64_t a, std::int64_t b, std::int64_t gust)
{
  if (kind == Lifetimes::FIXED) return 1.0;
  return -std::log(std::max(uniform_share(seed, 3, a, b, gust), 0x1p-53));
}
inline double phase(std::uint64_t seed, std::int64_t a)
{
  return uniform_share(seed, 4, a, 0, 0);
}

}    // namespace ClusterDEM
#endif
