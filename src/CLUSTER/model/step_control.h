// Time step of section "step" of the paper: bounds, the rule that rejects a step, and how the step is halved and
// grows back.

#ifndef CLUSTERDEM_STEP_CONTROL_H
#define CLUSTERDEM_STEP_CONTROL_H

#include "vector3.h"

#include <algorithm>
#include <cmath>

namespace ClusterDEM {

// Delta t <= C sqrt(m_i/k_n), C = pi/5 in the paper
inline double contact_step(double c, double lightest_mass, double k_n)
{
  return c * std::sqrt(lightest_mass / k_n);
}

// Time until a pair that approaches at `closing` overlaps by `most`; no bound if it does not approach.
inline double time_to_overlap(double overlap, double most, double closing)
{
  return closing > 0.0 ? std::max(0.0, most - overlap) / closing : INFINITY;
}

// Straight way of i relative to j, from `from` with velocity w for a time: how near it comes to 0, and how fast it
// approached when it set out.
struct Passage {
  double closest, closing;
};
inline Passage passage(const Vec3 &from, const Vec3 &w, double time)
{
  const double r = norm(from), toward = -dot(from, w), speed_sq = dot(w, w);
  const double when = toward > 0.0 ? std::min(time, toward / speed_sq) : 0.0;
  return {when > 0.0 ? norm(from + when * w) : r, r > 0.0 ? toward / r : 0.0};
}

// Energy that contacts created in a step, relative to the energy there was: the work they did plus the change of
// what their springs hold. Dissipation makes it negative. The paper tests the kinetic energy alone, which cannot hold
// where gravity, gas or a spring set free speed clusters up.
inline double relative_creation(double created, double energy)
{
  if (!(created > 0.0)) return 0.0;
  return energy > 0.0 ? created / energy : INFINITY;
}

// What contacts may create in a step, in sums over them. swing: k_n/m_eff times relative kinetic and elastic energy;
// velocity Verlet creates of the order of (omega dt)^2 of the energy of a contact with frequency omega. creep: tangential
// energy times speed over overlap; at constant displacement the tangential spring of Eq. (4) stiffens by up to a quarter as
// the normal load grows.
struct Restlessness {
  double swing = 0.0, creep = 0.0;
  double strongest = 0.0;    // largest force of a contact over the lighter mass
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

class StepSize {
 public:
  double most = 0.0;     // Delta t_m
  double floor = 0.0;    // no smaller step is tried
  int retries = 10;      // rejections in a row

  double now() const { return dt_; }
  int rejections_in_a_row() const { return rejected_; }
  void start(double dt)
  {
    dt_ = std::min(dt, most);
    rejected_ = quiet_ = 0;
  }

  // other bounds may have made the step shorter than now(): that one is what is halved
  void taken(double dt) { dt_ = dt; }

  // half of the step, not below the floor; false if there is nothing left to try
  bool halve()
  {
    quiet_ = 0;
    if (dt_ <= floor || rejected_ >= retries) return false;
    rejected_++;
    dt_ = std::max(0.5 * dt_, floor);
    return true;
  }

  // After some quiet steps in a row the step is tried twice as long. `error`: share of what would be too much.
  void accept(double error)
  {
    rejected_ = 0;
    quiet_ = error < QUIET_ERROR ? quiet_ + 1 : 0;
    if (quiet_ < QUIET_STEPS) return;
    quiet_ = 0;
    dt_ = std::min(2.0 * dt_, most);
  }

  // A step that could not be taken back is taken with less: the error of recent steps, which falls at least like
  // the step, is brought well below what would be too much.
  double cautious(double dt, double recent_error) const
  {
    return recent_error > QUIET_ERROR ? std::max(floor, dt * QUIET_ERROR / recent_error) : dt;
  }

 private:
  static constexpr double QUIET_ERROR = 0.25;    // twice the step makes up to four times the error
  static constexpr int QUIET_STEPS = 10;

  double dt_ = 0.0;
  int rejected_ = 0, quiet_ = 0;
};

}    // namespace ClusterDEM
#endif
