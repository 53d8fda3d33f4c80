// What the unit tests of the model share: the paper's numbers and reproducible random inputs.

#ifndef CLUSTERDEM_MODEL_TESTING_H
#define CLUSTERDEM_MODEL_TESTING_H

#include "model/cluster.h"
#include "model/drag_law.h"
#include "model/vector3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace ClusterDEM {

// the paper's particle, gas and gravity (section 3.2.1)
inline const ClusterGeometry paper_geometry{100.0e-6, 2000.0, 0.5};
inline const Gas paper_gas{1.2, 1.53e-5};
constexpr double gravity = 9.81;

constexpr double EPS = std::numeric_limits<double>::epsilon();    // 2.2e-16, one unit in the last place of 1

// Inputs from a fixed seed. Only the raw 64 bits of the generator are used: they are the same with
// every standard library, its distributions are not.
class RandomInputs {
 public:
  explicit RandomInputs(std::uint64_t seed) : bits_(seed) {}

  double uniform(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  int integer(int lo, int hi)
  {
    return lo + static_cast<int>(bits_() % (static_cast<std::uint64_t>(hi) - lo + 1));
  }
  bool coin() { return bits_() & 1; }
  std::uint64_t word() { return bits_(); }

  // every component of either sign, magnitudes over all decades up to `largest`, now and then 0
  Vec3 vector(double largest)
  {
    Vec3 v;
    for (double &c : v) {
      c = log_uniform(1.0e-12 * largest, largest) * (coin() ? 1.0 : -1.0);
      if (integer(0, 19) == 0) c = 0.0;
    }
    return v;
  }

  // a primary particle from 1 um to 5 mm, from aerogel to tungsten, at any voidage that packs
  ClusterGeometry geometry() { return {log_uniform(1.0e-6, 5.0e-3), log_uniform(1.0, 2.0e4), uniform(0.0, 0.95)}; }
  // gas from near vacuum to hundreds of bar
  Gas gas() { return {log_uniform(1.0e-3, 300.0), log_uniform(1.0e-8, 1.0e-2)}; }

 private:
  std::mt19937_64 bits_;
};

inline bool finite(const Vec3 &v)
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

// |a - b| <= tolerance |b|
inline ::testing::AssertionResult relatively_near(double a, double b, double tolerance)
{
  if (std::fabs(a - b) <= tolerance * std::fabs(b)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a << " differs from " << b << " by " << (a - b) / b << " of it, allowed "
                                       << tolerance;
}

}    // namespace ClusterDEM
#endif
