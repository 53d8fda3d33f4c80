// Energy that contacts create in a time step, which only too large a step lets them do, and what a step may create.

#ifndef CLUSTERDEM_STEP_ENERGY_H
#define CLUSTERDEM_STEP_ENERGY_H

#include "vector3.h"

#include <algorithm>
#include <cmath>

namespace ClusterDEM {

inline double twice_kinetic_energy(double mass, const double *v)
{
  return mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// Work of a force in a step of velocity Verlet that has this force at one of its ends: of the gain dt/4 (F + F')(v + v')
// the part of F. This is 4/dt of it; of a torque with angular velocities alike.
inline double quarter_work(const Vec3 &force, const Vec3 &v_start, const Vec3 &v_end)
{
  return dot(force, v_end + v_start);
}
inline double contact_work(double dt, double sum_of_quarters)
{
  return 0.25 * dt * sum_of_quarters;
}

// Velocity at the start of a step, of a cluster that had only `other` forces then, as they still are at its end: half a
// step of them is in its velocity before the second half of velocity Verlet.
inline Vec3 velocity_at_start(const Vec3 &v_half, const Vec3 &other_forces, double mass, double dt, double ftm2v)
{
  const double half = 0.5 * dt * ftm2v;
  return v_half - (half / mass) * other_forces;
}

// Energy that contacts created in a step, relative to the energy there was: the work they did plus the change of
// what their springs hold. Dissipation makes it negative. The paper tests the kinetic energy alone, which cannot hold
// where gravity, gas or a spring set free speed clusters up.
inline double relative_creation(double created, double energy)
{
  if (!(created > 0.0)) return 0.0;
  return energy > 0.0 ? created / energy : INFINITY;
}

// Energy below this share of the largest in a run is that of rounded positions.
inline constexpr double ROUNDED_ENERGY = 1.0e-12;

// Error of recent steps, as a share of what would be too much: the largest, forgotten by a fifth per step.
inline double recent_error(double before, double now)
{
  return std::max(now, 0.8 * before);
}

// What contacts may create in a step, in sums over them. swing: k_n/m_eff times relative kinetic and elastic energy;
// velocity Verlet creates of the order of (omega dt)^2 of the energy of a contact with frequency omega. creep: tangential
// energy times speed over overlap; at constant displacement the tangential spring of Eq. (4) stiffens by up to a quarter as
// the normal load grows.
struct Restlessness {
  double swing = 0.0, creep = 0.0;
  double strongest = 0.0;    // largest force of a contact over the lighter mass

  // A contact with reduced mass m, relative speed squared, elastic energy, tangential energy within it; `share` of it is
  // counted here (a pair of two ranks stands on both).
  void add_swing(double share, double k_n, double speed_sq, double energy, double m)
  {
    swing += share * k_n * (0.5 * speed_sq + energy / m);
  }
  void add_creep(double share, double tangential, double speed_sq, double overlap)
  {
    creep += share * tangential * std::sqrt(speed_sq) / overlap;
  }
  void add_force(double force, double mass_i, double mass_j)
  {
    const double acceleration = force / std::min(mass_i, mass_j);
    if (acceleration > strongest) strongest = acceleration;
  }
};

// No cluster is accelerated by contacts by more than this many times `strongest`: twelve equal spheres touch one, and
// the more numerous smaller ones around a larger one are the lighter for it.
inline constexpr double MOST_CONTACTS = 12.0;

// Their sum, with a margin, and for ten contacts that begin at approach c: (omega dt)^4/8 of m c^2 each (exact for the
// linear spring). Where this is too much a step is prepared to be taken back.
inline double possible_creation(double dt, const Restlessness &now, double k_n, double lightest, double heaviest,
                                double c)
{
  const double swing = k_n * dt * dt / (0.5 * lightest);    // (omega dt)^2 at most
  return 4.0 * (dt * dt * now.swing + 0.25 * dt * now.creep) +
      10.0 * 0.125 * swing * swing * 0.5 * heaviest * c * c;
}

}    // namespace ClusterDEM
#endif
