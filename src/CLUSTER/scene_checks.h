/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What must hold around fix cluster/breakmerge in a user's scene; each check stops the run with the remedy in words.

#ifndef LMP_SCENE_CHECKS_H
#define LMP_SCENE_CHECKS_H

#include "engine.h"

#include "breakmerge_settings.h"

#include <string>

namespace LAMMPS_NS {

class SceneChecks : protected EnginePointers {
 public:
  SceneChecks(class LAMMPS *lmp, class Fix *f, const std::string &name, const BreakMergeSettings &s) :
      EnginePointers(lmp), fix(f), me(name), settings(s)
  {
  }

  void check_engine() const;         // integrator, pair style, one fix of this style
  void check_order() const;          // of fixes
  void check_foreign() const;        // what changes or binds clusters behind the fix's back
  void check_room() const;           // claim, ghosts, periodic sides
  void check_lattice() const;        // how many sites fragments may take
  void check_part_of_box() const;    // of each rank: changes with the box and its division

 private:
  class Fix *fix;
  const std::string me;
  const BreakMergeSettings &settings;

  std::string periodic_box_too_short() const;
};

}    // namespace LAMMPS_NS
#endif
