/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The time that has passed while the step changes, and while some steps do not count.

#ifndef LMP_STEP_CLOCK_H
#define LMP_STEP_CLOCK_H

#include "pointers.h"

namespace LAMMPS_NS {

class StepClock : protected Pointers {
 public:
  StepClock(class LAMMPS *lmp) : Pointers(lmp) {}

  void set(double dt);      // the coming step, told to all who use it
  void take_back();         // this step's number has passed, its time has not
  void stand_at(bigint);    // an earlier step of this run

 private:
  void pass(bigint step);    // up to the end of that step, at the present dt
};

}    // namespace LAMMPS_NS
#endif
