// Soft-sphere contact, Eqs. (3) and (4), and what it stores in its springs. For a pair i, j: the normal
// points from j to i, velocities are of i relative to j, forces act on i.

#ifndef CLUSTERDEM_CONTACT_LAW_H
#define CLUSTERDEM_CONTACT_LAW_H

#include "vector3.h"

#include <algorithm>

namespace ClusterDEM {

enum class Tangential { MD, LINEAR, NONE };    // MD: Mindlin-Deresiewicz, Eq. (4)
enum class FrictionDirection { DISPLACEMENT, VELOCITY };

inline constexpr double CONTACT_PI = 3.14159265358979323846;

// Damping ratio of the linear spring-dashpot with coefficient of restitution e: 1 (critical) at e = 0.
inline double damping_ratio(double e)
{
  if (!(e > 0.0)) return 1.0;
  const double log_e = std::log(e);
  return -log_e / std::sqrt(CONTACT_PI * CONTACT_PI + log_e * log_e);
}

// delta_max/delta_n = mu (2 - nu)/(2 (1 - nu)) of Eq. (4)
inline double slip_ratio_poisson(double mu, double nu)
{
  return mu * (2.0 - nu) / (2.0 * (1.0 - nu));
}

// the same from a tangential stiffness: delta_max = 1.5 mu F_n/k_t (Hertz-Mindlin), F_n = k_n delta_n
inline double slip_ratio_stiffness(double mu, double k_n, double k_t)
{
  return 1.5 * mu * k_n / k_t;
}

// linear tangential spring that goes with k_n (Mindlin): k_t/k_n = 2 (1 - nu)/(2 - nu)
inline double stiffness_ratio(double nu)
{
  return 2.0 * (1.0 - nu) / (2.0 - nu);
}

// stiffness of the linear spring that holds this energy at this overlap
inline double secant_stiffness(double energy, double overlap)
{
  return 2.0 * energy / (overlap * overlap);
}

// Elastic energy of a linear and of a Hertzian spring; the latter's force is k overlap^(3/2) sqrt(R) with the reduced
// radius R = R_i R_j/(R_i + R_j).
inline double linear_energy(double k, double overlap)
{
  return 0.5 * k * overlap * overlap;
}
inline double hertz_energy(double k, double reduced_radius, double overlap)
{
  return 0.4 * k * std::sqrt(reduced_radius * overlap) * overlap * overlap;
}
inline double reduced_radius(double r_i, double r_j)
{
  return r_i * r_j / (r_i + r_j);
}

inline double reduced_mass(double m_i, double m_j)
{
  return m_i * m_j / (m_i + m_j);
}

class ContactLaw {
 public:
  double k_n = 0.0;    // normal stiffness [force/length]
  double e = 1.0;      // coefficient of restitution
  double mu = 0.0;     // coefficient of friction
  double nu = 0.25;    // Poisson's ratio, used where k_t is 0
  double k_t = 0.0;    // tangential stiffness [force/length], 0: from nu
  Tangential tangential = Tangential::MD;
  FrictionDirection direction = FrictionDirection::DISPLACEMENT;

  // call after any of the above has changed
  void derive()
  {
    damping_ = 2.0 * damping_ratio(e) * std::sqrt(k_n);
    spring_t_ = k_t > 0.0 ? k_t : stiffness_ratio(nu) * k_n;
    slip_ratio_ = k_t > 0.0 ? slip_ratio_stiffness(mu, k_n, k_t) : slip_ratio_poisson(mu, nu);
  }

  // eta_n of a pair of reduced mass m, and eta_t, which the paper sets equal to it [force/velocity]
  double damping(double m) const { return damping_ * std::sqrt(m); }

  // Eq. (3); positive pushes apart. v_n > 0 when the pair separates.
  double normal(double overlap, double eta, double v_n) const { return k_n * overlap - eta * v_n; }

  double normal_energy(double overlap) const { return linear_energy(k_n, overlap); }

  // Largest tangential displacement without sliding.
  double slip_limit(double overlap) const { return slip_ratio_ * overlap; }

  // Tangential force of Eq. (4), or of its linear stand-in, under normal force f_n. `displacement` is
  // cut back to what the spring can hold while the contact slides.
  Vec3 friction(double overlap, double f_n, double eta, const Vec3 &v_t, Vec3 &displacement) const
  {
    const double limit = mu * std::fabs(f_n);
    return tangential == Tangential::LINEAR ? linear_friction(limit, eta, v_t, displacement)
                                            : md_friction(overlap, limit, eta, v_t, displacement);
  }

  // Energy that the tangential spring gives back when it is let go at constant normal load. Friction
  // that opposes the velocity gives nothing back.
  double tangential_energy(double overlap, double f_n, const Vec3 &displacement) const
  {
    if (tangential == Tangential::NONE) return 0.0;
    const double s = norm(displacement);
    if (tangential == Tangential::LINEAR) return 0.5 * spring_t_ * s * s;
    const double most = slip_limit(overlap);
    if (direction == FrictionDirection::VELOCITY || !(most > 0.0)) return 0.0;
    const double rest = 1.0 - std::min(s, most) / most;
    return mu * std::fabs(f_n) * (std::min(s, most) - 0.4 * most * (1.0 - rest * rest * std::sqrt(rest)));
  }

  // Largest overlap of a pair of reduced mass m that is at `overlap` now and approaches at speed c > 0:
  // the peak of the damped oscillation of Eq. (3). No time step makes it smaller.
  double peak_overlap(double m, double overlap, double c) const
  {
    if (!(c > 0.0)) return overlap;
    const double w0 = std::sqrt(k_n / m), b = damping_ratio(e) * w0;
    const double w = std::sqrt(std::max(0.0, w0 * w0 - b * b));
    const double start = c + b * overlap;    // of the sine's amplitude
    const double angle = std::atan2(w * c, b * c + w0 * w0 * overlap);
    if (w * 1.0e6 < w0) {    // critically damped, where the angle and w vanish together
      const double t = c / (b * start);
      return std::exp(-b * t) * (overlap + start * t);
    }
    return std::exp(-b * angle / w) * (overlap * std::cos(angle) + start / w * std::sin(angle));
  }

  // Stiffness at which the approach that leads to `peak` would lead to `most` instead: overlaps of the linear
  // spring go with k_n^(-1/2) at the same e.
  double stiffness_for(double peak, double most) const { return k_n * (peak / most) * (peak / most); }

 private:
  double damping_ = 0.0, spring_t_ = 0.0, slip_ratio_ = 0.0;

  Vec3 md_friction(double overlap, double limit, double eta, const Vec3 &v_t, Vec3 &displacement) const
  {
    const double most = slip_limit(overlap);
    const double s = norm(displacement);
    const double rest = most > 0.0 ? 1.0 - std::min(s, most) / most : 0.0;
    const double spring = limit * (1.0 - rest * std::sqrt(rest));
    if (s > most) displacement = (most / s) * displacement;
    const bool by_velocity = direction == FrictionDirection::VELOCITY;
    const Vec3 &along = by_velocity ? v_t : displacement;
    const double length = norm(along);
    Vec3 force = (-eta) * v_t;
    if (length > 0.0) force = force - (spring / length) * along;
    return cap(force, limit);
  }

  Vec3 linear_friction(double limit, double eta, const Vec3 &v_t, Vec3 &displacement) const
  {
    const Vec3 force = (-spring_t_) * displacement - eta * v_t;
    // LAMMPS' own styles also put the damping force into the displacement here, which stores energy that nobody spent
    const double s = norm(displacement);
    if (spring_t_ * s > limit) displacement = (limit / (spring_t_ * s)) * displacement;
    return cap(force, limit);
  }

  static Vec3 cap(const Vec3 &force, double limit)
  {
    const double size = norm(force);
    return size > limit ? (limit / size) * force : force;
  }
};

// Stiffness of a linear spring that stops a pair of reduced mass m, approaching at c, at overlap `most`; without
// damping, which would help.
inline double stopping_stiffness(double m, double c, double most)
{
  return m * c * c / (most * most);
}

// Tangential displacement carried along with the turning contact: back into the tangent plane of the unit
// normal, its length kept.
inline Vec3 turn_into_plane(const Vec3 &displacement, const Vec3 &normal)
{
  const Vec3 flat = displacement - dot(displacement, normal) * normal;
  const double was = norm(displacement), is = norm(flat);
  return is > 0.0 ? (was / is) * flat : Vec3{0.0, 0.0, 0.0};
}

}    // namespace ClusterDEM
#endif
