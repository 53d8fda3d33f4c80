/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Walls of LAMMPS: fix wall/gran and wall/gran/region, and those that are planes beside.

#include "scene_walls.h"

#include "domain.h"
#include "fix_wall.h"
#include "fix_wall_gran.h"
#include "fix_wall_gran_region.h"
#include "fix_wall_reflect.h"
#include "region.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// walls tell nobody where they are, but let those that inherit from them look

namespace {

struct GranularWall : FixWallGran {
  static constexpr double NONE = 1.0e20;    // where a side has no plane, it says
  static int style(const FixWallGran &wall) { return wall.*(&GranularWall::wallstyle); }
  static double lo_of(const FixWallGran &wall) { return wall.*(&GranularWall::lo); }
  static double hi_of(const FixWallGran &wall) { return wall.*(&GranularWall::hi); }
  static bool wiggles_along(const FixWallGran &wall, int along)
  {
    return wall.*(&GranularWall::wiggle) && wall.*(&GranularWall::axis) == along;
  }
  // as fix wall/gran has it
  static double offset(const FixWallGran &wall, const Update *update)
  {
    const double time = (update->ntimestep - wall.*(&GranularWall::time_origin)) * update->dt;
    return wall.*(&GranularWall::amplitude) * (1.0 - std::cos(wall.*(&GranularWall::omega) * time));
  }
  // newer versions have no cylinder of their own any more
  template <class Wall = GranularWall>
  static auto cylinder(const FixWallGran &wall, int) -> decltype(wall.*(&Wall::cylradius))
  {
    return wall.*(&Wall::cylradius);
  }
  static double cylinder(const FixWallGran &, ...) { return 0.0; }
};

struct ReflectingWall : FixWallReflect {
  static int number(const FixWallReflect &wall) { return wall.*(&ReflectingWall::nwall); }
  static int side(const FixWallReflect &wall, int m) { return (wall.*(&ReflectingWall::wallwhich))[m]; }
  static int kind(const FixWallReflect &wall, int m) { return (wall.*(&ReflectingWall::wallstyle))[m]; }
  static double place(const FixWallReflect &wall, int m) { return (wall.*(&ReflectingWall::coord0))[m]; }
};

}    // namespace

/* ---------------------------------------------------------------------- */

void SceneWalls::find()
{
  planes.clear();
  cylinders.clear();
  regions.clear();
  unknown.clear();
  const Domain *domain = lmp->domain;
  for (const char *style : {"^wall/", "^indent"})
    for (Fix *fix : find_fixes(lmp, style)) {
      const std::string name = fmt::format("fix {} {}", fix->style, fix->id);
      auto add_side = [&](int side, int kind, double place) {
        if (kind == FixWall::VARIABLE) unknown.push_back(name + ", whose place is a variable");
        else if (kind == FixWall::EDGE)
          add_plane(side / 2, side % 2 ? domain->boxhi[side / 2] : domain->boxlo[side / 2]);
        else add_plane(side / 2, place);
      };
      if (const auto *of_region = dynamic_cast<const FixWallGranRegion *>(fix)) {
        const std::string fault = region_without_sides(of_region->region);
        if (fault.empty()) regions.push_back(of_region->region);
        else unknown.push_back(fmt::format("{}, whose region {} {},", name, of_region->region->id, fault));
      } else if (const auto *wall = dynamic_cast<const FixWallGran *>(fix)) {
        const int axis = GranularWall::style(*wall);
        if (axis > 2) {
          const double radius = GranularWall::cylinder(*wall, 0);
          if (radius > 0.0) add_cylinder(2, radius, 0.0, 0.0);
          else unknown.push_back(name);
          continue;
        }
        for (const double place : {GranularWall::lo_of(*wall), GranularWall::hi_of(*wall)}) {
          if (std::fabs(place) >= GranularWall::NONE) continue;
          if (!GranularWall::wiggles_along(*wall, axis)) add_plane(axis, place);
          else
            planes.push_back(
                {axis, [this, wall, place] { return place + GranularWall::offset(*wall, lmp->update); }, place});
        }
      } else if (const auto *flat = dynamic_cast<const FixWall *>(fix)) {
        for (int m = 0; m < flat->nwall; m++) add_side(flat->wallwhich[m], flat->xstyle[m], flat->coord0[m]);
      } else if (const auto *mirror = dynamic_cast<const FixWallReflect *>(fix)) {
        for (int m = 0; m < ReflectingWall::number(*mirror); m++)
          add_side(ReflectingWall::side(*mirror, m), ReflectingWall::kind(*mirror, m),
                   ReflectingWall::place(*mirror, m));
      } else unknown.push_back(name);
    }
}

/* ---------------------------------------------------------------------- */

bool LAMMPS_NS::region_holds(Region *region, const Vec3 &parent, const Vec3 &centre, double radius)
{
  if (region->surface(centre[0], centre[1], centre[2], radius)) return false;
  // match() is true everywhere for a region with open faces
  if (!region->openflag) return region->match(centre[0], centre[1], centre[2]);
  auto side = [&](const Vec3 &x) { return region->inside(x[0], x[1], x[2]); };
  return side(centre) == side(parent);
}
