/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the command of fix cluster/timestep asks for.

#ifndef LMP_STEP_SETTINGS_H
#define LMP_STEP_SETTINGS_H

namespace LAMMPS_NS {

struct StepSettings {
  double most = 0.0;             // DT_MAX
  double contact_factor;         // C, 0: no such bound
  double stiffness = 0.0;        // k_n, 0: that of pair gran/cluster
  double overlap_limit = 1.0;    // F: an overlap stays below F d_i
  bool energy_test = true;
  double tolerance = 1.0e-6;
  bool kinetic = false;    // the printed test: kinetic energy must not rise
  bool predict = true;
  double floor = 0.0;    // smallest step, 0: as the retries have it
  int retries = 10;      // rejections in a row

  StepSettings(class LAMMPS *, int narg, char **arg);    // stops with an error that names the bad word
};

}    // namespace LAMMPS_NS
#endif
