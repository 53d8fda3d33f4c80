/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What else a scene may hold while its time step changes and steps are repeated.

#ifndef LMP_STEP_SCENE_H
#define LMP_STEP_SCENE_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

// Fixes that a changing step or a repeated drift would lead astray; whole_steps: or a step that is taken back as a whole,
// by the energy test. Each with the reason and a remedy; empty: all is well.
std::vector<std::string> unfit_fixes(LAMMPS *, bool whole_steps);

// What puts forces between atoms beside pair style gran/cluster, for its energy is not known: as "pair style granular"
std::vector<std::string> other_forces(LAMMPS *);

}    // namespace LAMMPS_NS
#endif
