// Two spheres i and j that touch: where, and how they move against each other there. The normal points from j to i,
// velocities are of i relative to j.

#ifndef CLUSTERDEM_TOUCH_H
#define CLUSTERDEM_TOUCH_H

#include "vector3.h"

namespace ClusterDEM {

struct Touch {
  double r, overlap;    // distance of the centres; how far the surfaces go into each other
  Vec3 n;               // unit normal
  Vec3 velocity;        // of the centres
  double v_n;           // its normal part, > 0 when they separate
  Vec3 slip;            // tangential velocity where they touch
};

// without rotation; d = x_i - x_j, w = v_i - v_j
inline Touch touch_of(double radius_i, double radius_j, const Vec3 &d, const Vec3 &w)
{
  const double r = norm(d);
  const Vec3 n = (1.0 / r) * d;
  const double v_n = dot(w, n);
  return {r, radius_i + radius_j - r, n, w, v_n, w - v_n * n};
}

// A contact lies half of the overlap below each surface.
inline double contact_arm(double radius, double overlap)
{
  return radius - 0.5 * overlap;
}

// The same contact between spheres that turn.
inline Touch turning(Touch touch, double radius_i, const Vec3 &omega_i, double radius_j, const Vec3 &omega_j)
{
  const Vec3 spin =
      contact_arm(radius_i, touch.overlap) * omega_i + contact_arm(radius_j, touch.overlap) * omega_j;
  touch.slip = touch.slip - cross(spin, touch.n);
  return touch;
}

}    // namespace ClusterDEM
#endif
