/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "granular_walls.h"

// walls of LIGGGHTS are not looked at
std::string LAMMPS_NS::wall_inside_the_box(LAMMPS *, bool)
{
  return "";
}
