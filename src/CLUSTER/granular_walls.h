/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Walls of fix wall/gran where the box shows none: fragments would be placed behind them.

#ifndef LMP_GRANULAR_WALLS_H
#define LMP_GRANULAR_WALLS_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;

// What the first such wall is, as "fix wall/gran ID: a plane at x = 0.01"; empty if there is none. A wall on a fixed
// side of the box is known to the placement, and so is one in y to clusters that stay in the xz plane.
std::string wall_inside_the_box(LAMMPS *, bool planar);

}    // namespace LAMMPS_NS
#endif
