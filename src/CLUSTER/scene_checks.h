/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What must hold around fix cluster/breakmerge in a user's scene; each check stops the run with the remedy in words.

#ifndef LMP_SCENE_CHECKS_H
#define LMP_SCENE_CHECKS_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "largest_diameters.h"
#include "requirements.h"

#include <string>

namespace LAMMPS_NS {

class SceneChecks : protected EnginePointers {
 public:
  SceneChecks(class LAMMPS *lmp, class Fix *f, const std::string &name, const BreakMergeSettings &s) :
      EnginePointers(lmp), fix(f), me(name), settings(s)
  {
  }

  void check_engine(Requirements &) const;     // integrator, pair style, units, one fix of this style
  void check_order(Requirements &) const;      // of fixes
  void check_foreign(Requirements &) const;    // what changes or binds clusters behind the fix's back
  void check_gravity(Requirements &) const;    // against that of other fixes
  void check_groups(Requirements &) const;     // who holds and moves the clusters
  void check_plane(Requirements &) const;      // that clusters lie in, with plane xz
  void check_step(Requirements &, double stiffness) const;    // against the contacts of the smallest clusters
  void check_room(Requirements &) const;                      // claim, periodic sides
  void check_ghosts(Requirements &,
                    const LargestDiameters &) const;    // that ranks see what is in the way of events
  void check_lattice(Requirements &) const;             // how many sites fragments may take
  void check_part_of_box() const;                       // of each rank: changes with the box and its division

 private:
  class Fix *fix;
  const std::string me;
  const BreakMergeSettings &settings;

  bool reruns() const;    // positions of a dump, by command rerun
  std::string periodic_box_too_short() const;
  bigint count_outside(int other) const;    // clusters of the group that are not in the other one
};

}    // namespace LAMMPS_NS
#endif
