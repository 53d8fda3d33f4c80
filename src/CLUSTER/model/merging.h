// When two clusters merge, and into what (paper section 2, the criterion made symmetric).

#ifndef CLUSTERDEM_MERGING_H
#define CLUSTERDEM_MERGING_H

#include "vector3.h"

#include <algorithm>
#include <limits>

namespace ClusterDEM {

// |dV| / min(|V_i|, |V_j|): symmetric to the last bit, so both sides of a pair agree.
// Two clusters at rest move alike: 0.
inline double relative_slip(const Vec3 &v_i, const Vec3 &v_j)
{
  const double dv = norm(v_i - v_j);
  if (dv == 0.0) return 0.0;
  const double slowest = std::min(norm(v_i), norm(v_j));
  return slowest > 0.0 ? dv / slowest : std::numeric_limits<double>::infinity();
}

inline bool fits_together(int n_i, int n_j, int n_l)
{
  return n_i <= n_l - n_j;
}

// of an intensive value
inline double mass_mean(double m_i, double a_i, double m_j, double a_j)
{
  return a_i + m_j / (m_i + m_j) * (a_j - a_i);
}

// What becomes of a value that clusters carry: fragments / the merged cluster have
enum class CarryRule {
  COPY,     // the parent's / that of the cluster which leads
  SPLIT,    // a share in proportion to mass / the sum
  MEAN,     // the parent's / the mass mean
  SUM       // the parent's / the sum
};
inline bool sums_up(CarryRule rule)
{
  return rule == CarryRule::SPLIT || rule == CarryRule::SUM;
}
inline bool is_mean(CarryRule rule)
{
  return rule == CarryRule::MEAN;
}

struct Body {
  double mass;
  Vec3 x, v;
};

// mass, momentum and centre of mass conserved; x_j must be the image nearest to x_i
inline Body combine(const Body &i, const Body &j)
{
  const double mass = i.mass + j.mass;
  const double share = j.mass / mass;
  return {mass, i.x + share * (j.x - i.x), (i.mass / mass) * i.v + share * j.v};
}

// Spin of the merged sphere: that of both parents is kept (I = 2/5 m r^2), which never adds energy. A mean
// of the angular velocities would: I of the merged sphere is larger than of both.
struct Spinning {
  double mass, radius;
  Vec3 omega;
  double inertia() const { return 0.4 * mass * radius * radius; }
  double energy() const { return 0.5 * inertia() * dot(omega, omega); }
};
inline Vec3 merged_spin(const Spinning &i, const Spinning &j, double radius)
{
  const double inertia = Spinning{i.mass + j.mass, radius, {}}.inertia();
  return (i.inertia() / inertia) * i.omega + (j.inertia() / inertia) * j.omega;
}

// kinetic energy that the inelastic merge takes out: 1/2 m_eff |dV|^2
inline double energy_lost(const Body &i, const Body &j)
{
  const double dv = norm(i.v - j.v);
  return 0.5 * (i.mass * j.mass / (i.mass + j.mass)) * dv * dv;
}

// Energy that a merged cluster puts in where it touches a third one: what their contact holds, beyond what those of its
// parents with the third one held. What is less is not credited to others.
inline double birth_energy(double after, double before)
{
  return std::max(0.0, after - before);
}

// a merged cluster may put in this share of its own kinetic energy, or the merge waits
inline constexpr double BIRTH_TOLERANCE = 1.0e-6;
inline bool negligible_birth(double energy, const Body &merged)
{
  return energy <= BIRTH_TOLERANCE * 0.5 * merged.mass * dot(merged.v, merged.v);
}

}    // namespace ClusterDEM
#endif
