/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "cluster_walls.h"

#include "domain.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void ClusterWalls::init(const std::string &me, Requirements &all)
{
  region = nullptr;
  if (!settings.region_id.empty()) {
    region = region_of(domain, settings.region_id);
    all.unmet_if(!region, fmt::format("{}: region ID {} does not exist", me, settings.region_id));
    const std::string fault = region ? region_without_sides(region) : "";
    all.unmet_if(!fault.empty(), fmt::format("{}: region {} {}", me, settings.region_id, fault));
  }
  walls.find();
  if (!region)    // which is promised to lie within all of them
    for (const std::string &wall : walls.unseen())
      all.unmet(fmt::format(
          "{} does not see where {} is, and would place clusters behind it: give the keyword region with the "
          "ID of a region within the walls",
          me, wall));
}

void ClusterWalls::prepare()
{
  walls.prepare();
  if (region) prepare_regions({region});
}

/* ---------------------------------------------------------------------- */

Walls ClusterWalls::around(const Vec3 &parent) const
{
  Walls here;
  for (int axis = 0; axis < 3; axis++) {
    const bool side = !domain->periodicity[axis] && !(settings.planar && axis == 1);
    here.lo[axis] = side ? domain->boxlo[axis] - parent[axis] : -INFINITY;
    here.hi[axis] = side ? domain->boxhi[axis] - parent[axis] : INFINITY;
  }
  here.inside = [this, parent](const Vec3 &p, double radius) {
    const Vec3 centre = parent + p;
    return walls.hold(parent, centre, radius, settings.planar) &&
        (!region || region_holds(region, parent, centre, radius));
  };
  return here;
}
