/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Walls of LIGGGHTS: the headers of its packages do not let anybody look where they are, so that all of them must be told by a
// region.

#include "scene_walls.h"

#include "region.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void SceneWalls::find()
{
  unknown.clear();
  for (Fix *fix : find_fixes(lmp, "^wall/")) unknown.push_back(fmt::format("fix {} {}", fix->style, fix->id));
}

bool LAMMPS_NS::region_holds(Region *region, const Vec3 &, const Vec3 &centre, double radius)
{
  return region->match(centre[0], centre[1], centre[2]) &&
      region->surface(centre[0], centre[1], centre[2], radius) == 0;
}
