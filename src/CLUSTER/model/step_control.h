// Time step of section "step" of the paper: bounds, the rule that rejects a step, and how the step is halved and
// grows back.

#ifndef CLUSTERDEM_STEP_CONTROL_H
#define CLUSTERDEM_STEP_CONTROL_H

#include "step_energy.h"
#include "vector3.h"

#include <algorithm>
#include <cmath>

namespace ClusterDEM {

// Delta t <= C sqrt(m_i/k_n), C = pi/5 in the paper
inline constexpr double PAPER_CONTACT_SHARE = 3.14159265358979323846 / 5.0;
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

// Two spheres as a step sees them: d = x_i - x_j at its end, w = v_i - v_j its straight way's velocity.
struct Approach {
  double overlap;    // largest on that way, negative: how far apart
  double closing;    // speed of approach at its beginning
  double smaller;    // diameter

  double depth() const { return overlap / smaller; }
  double time_to(double depth_limit) const { return time_to_overlap(overlap, depth_limit * smaller, closing); }
};
inline Approach approach(double radius_i, double radius_j, const Vec3 &d, const Vec3 &w, double time)
{
  const Passage way = passage(d - time * w, w, time);
  return {radius_i + radius_j - way.closest, way.closing, 2.0 * std::min(radius_i, radius_j)};
}

// What bounds the motion of all clusters. All velocities and forces are looked at now and then; in between what pushes them
// is known, and other forces are taken to grow no more than by OTHER_FORCES.
class MotionBounds {
 public:
  static constexpr double OTHER_FORCES = 2.0;    // how much they may grow between looks
  static constexpr double MARGIN = 1.01;         // and what they may do where there were none

  // range: of velocities, as the diagonal of the box that they fill; none is larger than `fastest`
  void looked(double range, double fastest, double acceleration)
  {
    closing_ = range_ = range;
    speed_ = fastest_ = fastest;
    acceleration_ = acceleration_at_look_ = acceleration;
    gain_ = 0.0;
  }

  // a step of dt has ended since, and no cluster is accelerated by more now
  void pushed(double acceleration, double dt)
  {
    gain_ += 0.5 * (acceleration_ + acceleration) * dt;
    acceleration_ = acceleration;
    closing_ = MARGIN * range_ + 2.0 * gain_;
    speed_ = MARGIN * fastest_ + gain_;
  }

  // acceleration by contacts whose strongest is known, and by the other forces of the last look
  double with_contacts(double strongest) const
  {
    return OTHER_FORCES * acceleration_at_look_ + MOST_CONTACTS * strongest;
  }

  double closing() const { return closing_; }    // no two clusters approach each other faster now
  double closing_within(double dt) const { return closing_ + dt * acceleration_; }
  double approach_within(double dt) const { return closing_within(dt) * dt; }
  double way_within(double dt) const { return (speed_ + dt * acceleration_) * dt; }
  double way_without_force(double dt) const { return speed_ * dt; }

 private:
  double closing_ = 0.0, speed_ = 0.0, acceleration_ = 0.0;
  double range_ = 0.0, fastest_ = 0.0, gain_ = 0.0, acceleration_at_look_ = 0.0;
};

// Bound on the depth of any overlap, when any two clusters have come nearer to each other by `way`. Depths are overlaps as
// shares of the smaller diameter.
inline double depth_after(double bound, double way, double smallest_diameter)
{
  return std::max(0.0, bound) + way / smallest_diameter;
}

// A step in which no two clusters can pass each other unseen, and which ends at 0.9 of the time in which the first pair
// would reach the limit.
inline double predicted_step(double dt, double depth_limit, double smallest_diameter, double closing,
                             double soonest)
{
  if (closing > 0.0) dt = std::min(dt, 0.5 * depth_limit * smallest_diameter / closing);
  return std::min(dt, 0.9 * soonest);
}

// Where the law is not known: a pair that is deep in contact, and still comes nearer, will not be stopped.
inline bool deep_and_closing(double overlap, double closing, double most)
{
  return overlap > 0.5 * most && closing > 0.0;
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
