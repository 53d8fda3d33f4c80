/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "scene_walls.h"

#include "model/wall_shapes.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void SceneWalls::add_plane(int axis, double position)
{
  planes.push_back({axis, [position] { return position; }, position});
}

void SceneWalls::add_cylinder(int axis, double radius, double a, double b)
{
  Vec3 middle = {a, b, 0.0};
  if (axis == 0) middle = {0.0, a, b};
  if (axis == 1) middle = {a, 0.0, b};
  cylinders.push_back({axis, radius, middle});
}

void SceneWalls::prepare()
{
  for (Plane &plane : planes) plane.now = plane.position();
  prepare_regions(regions);
}

/* ---------------------------------------------------------------------- */

bool SceneWalls::hold(const Vec3 &parent, const Vec3 &centre, double radius, bool planar) const
{
  for (const Plane &plane : planes)
    if (!(planar && plane.axis == 1) && !beside_plane(plane.axis, plane.now, parent, centre, radius)) return false;
  for (const Cylinder &tube : cylinders)
    if (!beside_cylinder(tube.axis, tube.middle, tube.radius, parent, centre, radius)) return false;
  for (Region *region : regions)
    if (!region_holds(region, parent, centre, radius)) return false;
  return true;
}
