/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "cluster_walls.h"

#include "granular_walls.h"

#include "domain.h"
#include "error.h"
#include "region.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ----------------------------------------------------------------------
   fragments stay within non-periodic sides of the box; other walls must be told
------------------------------------------------------------------------- */

void ClusterWalls::init(const std::string &me)
{
  region = nullptr;
  if (!settings.region_id.empty()) {
    region = region_of(domain, settings.region_id);
    if (!region) error->all(FLERR, "{}: region ID {} does not exist", me, settings.region_id);
    return;
  }
  const std::string wall = settings.breaking ? wall_inside_the_box(lmp, settings.planar) : "";
  if (!wall.empty())
    error->all(FLERR,
               "{} does not see {}, and would place fragments behind it: let a fixed side of the box be that "
               "wall, or give the keyword region with the ID of a region within the walls",
               me, wall);
}

/* ---------------------------------------------------------------------- */

void ClusterWalls::prepare()
{
  if (region) region->prematch();
}

Walls ClusterWalls::around(const Vec3 &origin) const
{
  Walls walls;
  for (int axis = 0; axis < 3; axis++) {
    const bool wall = !domain->periodicity[axis] && !(settings.planar && axis == 1);
    walls.lo[axis] = wall ? domain->boxlo[axis] - origin[axis] : -INFINITY;
    walls.hi[axis] = wall ? domain->boxhi[axis] - origin[axis] : INFINITY;
  }
  if (region)
    walls.inside = [this, origin](const Vec3 &p, double radius) {
      const Vec3 q = origin + p;
      return region->match(q[0], q[1], q[2]) && region->surface(q[0], q[1], q[2], radius) == 0;
    };
  return walls;
}
