/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The state of this rank's clusters at the start of a step, so that the step can be undone: their motion, the forces on
// them, and the contact history of walls. (Pair gran/cluster keeps that of its own contacts.)

#ifndef LMP_STEP_STATE_H
#define LMP_STEP_STATE_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class StepState : protected Pointers {
 public:
  StepState(class LAMMPS *lmp) : Pointers(lmp) {}

  void forget() { clusters = -1; }
  void keep(bool forces);    // for the drift alone forces and wall contacts need not be kept
  bool whole() const { return clusters >= 0 && with_forces; }

  void put_back_motion();    // positions, velocities, angular velocities
  void put_back();           // and forces, torques, wall contacts

  double bytes() const;

 private:
  std::vector<double> x, v, omega, f, torque;
  int clusters = -1;    // -1: nothing is kept
  bool with_forces = false;

  struct Wall {
    class Fix *fix;
    std::vector<double> history;    // of all clusters, as the fix packs it
  };
  std::vector<Wall> walls;

  void keep_walls();
};

}    // namespace LAMMPS_NS
#endif
