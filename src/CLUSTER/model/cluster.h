// A cluster: n primary particles at a fixed internal voidage. Particle count <-> diameter <-> mass.
// Source: paper section 3.2.1 (voidage 0.5; 400 particles of 100 um make 928 um).

#ifndef CLUSTERDEM_CLUSTER_H
#define CLUSTERDEM_CLUSTER_H

#include <cmath>
#include <cstdint>

namespace ClusterDEM {

constexpr double PI = 3.14159265358979323846;

inline double sphere_volume(double diameter)
{
  return PI / 6.0 * diameter * diameter * diameter;
}
inline double sphere_density(double mass, double diameter)
{
  return mass / sphere_volume(diameter);
}

struct ClusterGeometry {
  double d_p;              // diameter of a primary particle [length]
  double rho_p;            // density of a primary particle [mass/volume]
  double voidage = 0.5;    // void fraction inside a cluster [-]

  double particle_volume() const { return PI / 6.0 * d_p * d_p * d_p; }
  double particle_mass() const { return rho_p * particle_volume(); }

  double mass(double n) const { return n * particle_mass(); }

  // of a cluster as a sphere
  double density() const { return rho_p * (1.0 - voidage); }

  // equivalent diameter of n particles at the internal voidage
  double diameter(double n) const { return d_p * std::cbrt(n / (1.0 - voidage)); }

  // number of particles, not rounded, that fill a sphere of diameter d
  double particles_in(double d) const
  {
    const double ratio = d / d_p;
    return (1.0 - voidage) * ratio * ratio * ratio;
  }

  // Particle count of a cluster of mass m. `whole` is false where m is not a whole number of
  // particles within 1e-6 of a particle per particle of the cluster.
  struct Count {
    int n;
    double exact;
    bool whole;
  };
  Count count_from_mass(double m) const
  {
    const double exact = m / particle_mass();
    if (!(exact > 0.5) || exact > 2.0e9) return {0, exact, false};
    const int n = static_cast<int>(std::lround(exact));
    return {n, exact, std::fabs(exact - n) <= 1.0e-6 * n};
  }
};

struct SizeLimits {
  int lo = 3;       // fewest particles of a cluster (181.7 um in the paper)
  int hi = 2000;    // most particles of a cluster (1587.4 um in the paper)

  int clamp(double n) const
  {
    if (!(n > lo)) return lo;    // NaN, too
    if (n >= hi) return hi;
    return static_cast<int>(n);
  }
};

}    // namespace ClusterDEM
#endif
