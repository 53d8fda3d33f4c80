// Walls as fragments and merged clusters meet them: a sphere must lie on that side of a wall on which its parent is, and not in it.

#ifndef CLUSTERDEM_WALL_SHAPES_H
#define CLUSTERDEM_WALL_SHAPES_H

#include "vector3.h"

#include <cmath>

namespace ClusterDEM {

// a plane at `position` along an axis
inline bool beside_plane(int axis, double position, const Vec3 &parent, const Vec3 &centre, double radius)
{
  if (parent[axis] >= position) return centre[axis] - radius >= position;
  return centre[axis] + radius <= position;
}

// a cylinder of radius R about a line along an axis through `middle`
inline bool beside_cylinder(int axis, const Vec3 &middle, double wall_radius, const Vec3 &parent,
                            const Vec3 &centre, double radius)
{
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  auto distance = [&](const Vec3 &x) { return std::hypot(x[a] - middle[a], x[b] - middle[b]); };
  if (distance(parent) <= wall_radius) return distance(centre) + radius <= wall_radius;
  return distance(centre) - radius >= wall_radius;
}

}    // namespace ClusterDEM
#endif
