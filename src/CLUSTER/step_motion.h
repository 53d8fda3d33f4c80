/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What bounds the motion of all clusters on all ranks: looked at now and then, in between reckoned from what pushes them.

#ifndef LMP_STEP_MOTION_H
#define LMP_STEP_MOTION_H

#include "pointers.h"

#include "model/step_control.h"

#include <string>

namespace LAMMPS_NS {
class PairGranCluster;

class StepMotion : protected Pointers {
 public:
  StepMotion(class LAMMPS *lmp, const std::string &fix) : Pointers(lmp), me(fix) {}

  void set_pair(const PairGranCluster *pair) { style = pair; }    // null: another pair style

  void weigh();                       // masses and diameters, which change with the lists alone
  void must_look() { due = true; }    // clusters changed, or were moved by other than forces
  bool look_due() { return due || ++looks_ago >= LOOK_EVERY; }
  bool looked_just_now() const { return looks_ago == 0; }
  void look();
  void reckon();    // at the end of a step in which nobody looked

  const ClusterDEM::MotionBounds &bounds() const { return motion; }
  double lightest() const { return least_mass; }
  double heaviest() const { return most_mass; }
  double smallest() const { return least_diameter; }

 private:
  static constexpr int LOOK_EVERY = 8;    // steps

  std::string me;
  const PairGranCluster *style = nullptr;
  ClusterDEM::MotionBounds motion;
  double least_mass = 0.0, most_mass = 0.0, least_diameter = 0.0;
  int looks_ago = 0;
  bool due = true;

  double strongest_contact() const;
  double largest_force() const;
  [[noreturn]] void stop_not_finite() const;
};

}    // namespace LAMMPS_NS
#endif
