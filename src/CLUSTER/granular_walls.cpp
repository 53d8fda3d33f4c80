/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "granular_walls.h"

#include "domain.h"
#include "fix_wall_gran.h"
#include "fmt/format.h"
#include "lammps.h"
#include "modify.h"

#include <cmath>

using namespace LAMMPS_NS;

// fix wall/gran tells nobody where its planes are, but lets those that inherit from it look
struct WallPlanes : FixWallGran {
  static constexpr double NONE = 1.0e20;    // where a side has no plane, it says
  static bool plane(const FixWallGran &wall) { return wall.*(&WallPlanes::wallstyle) <= 2; }    // x, y or z
  static bool moves(const FixWallGran &wall) { return wall.*(&WallPlanes::wiggle); }
  static int axis_of(const FixWallGran &wall) { return wall.*(&WallPlanes::wallstyle); }
  static double lo_of(const FixWallGran &wall) { return wall.*(&WallPlanes::lo); }
  static double hi_of(const FixWallGran &wall) { return wall.*(&WallPlanes::hi); }
};

/* ---------------------------------------------------------------------- */

std::string LAMMPS_NS::wall_inside_the_box(LAMMPS *lmp, bool planar)
{
  const Domain *domain = lmp->domain;
  for (const auto &fix : lmp->modify->get_fix_by_style("^wall/gran")) {
    const std::string me = fmt::format("fix {} {}", fix->style, fix->id);
    const auto *wall = dynamic_cast<const FixWallGran *>(fix);
    if (!wall || !WallPlanes::plane(*wall)) return me + ": not a plane";
    const int axis = WallPlanes::axis_of(*wall);
    if (planar && axis == 1) continue;
    if (WallPlanes::moves(*wall)) return me + ": a plane that moves";
    const double tolerance = 1.0e-9 * domain->prd[axis];
    const bool fixed = domain->periodicity[axis] == 0;
    for (const double x : {WallPlanes::lo_of(*wall), WallPlanes::hi_of(*wall)}) {
      const bool known = fixed &&
          (std::fabs(x - domain->boxlo[axis]) <= tolerance || std::fabs(x - domain->boxhi[axis]) <= tolerance);
      if (std::fabs(x) < WallPlanes::NONE && !known)
        return fmt::format("{}: a plane at {} = {}", me, "xyz"[axis], x);
    }
  }
  return "";
}
