/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The gas, as its clusters see it: velocity, density and viscosity at the place of each. It is prescribed by the command
// of fix drag/cluster; the size law of fix cluster/breakmerge asks for it here, too.

#ifndef LMP_PRESCRIBED_GAS_H
#define LMP_PRESCRIBED_GAS_H

#include "engine.h"

#include "gas_fluctuation.h"
#include "gas_frames.h"
#include "mean_velocity.h"
#include "model/drag_law.h"
#include "model/gas_field.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {
class StyleArguments;

class PrescribedGas : protected EnginePointers {
 public:
  PrescribedGas(class LAMMPS *lmp) :
      EnginePointers(lmp), gas{}, mean(lmp), profile_axis(-1), fluctuation(lmp), igroup(0)
  {
  }

  // the words of the command; `me` is the fix in messages
  void parse_properties(StyleArguments &);
  void parse_profile(StyleArguments &, const std::string &style);
  void parse_field(StyleArguments &, const std::string &me);
  MeanVelocity &mean_velocity() { return mean; }
  GasFluctuation &gusts() { return fluctuation; }
  void settle(ClusterTable &, int igroup, const std::string &me);    // once all words are read

  void init(const std::string &me);

  // Variables: once per step, after clusters have migrated and before anything of the step is reset. All else follows
  // from place and time, and can be asked for at any moment after prepare().
  void evaluate_variables() { mean.evaluate(me, igroup); }
  void prepare();
  ClusterDEM::LocalGas at(int i);    // of owned cluster i

  const ClusterDEM::Gas &properties() const { return gas; }    // where no field says otherwise
  bool uniform_properties() const;
  bool any_variable() const { return mean.any_variable(); }
  double field_bytes() const { return frames ? frames->bytes() : 0.0; }

 private:
  std::string me;
  ClusterDEM::Gas gas;
  MeanVelocity mean;
  ClusterDEM::GasProfile profile;
  int profile_axis;                     // -1: none
  std::unique_ptr<GasFrames> frames;    // from files: velocity, and what else they hold
  GasFluctuation fluctuation;
  int igroup;
};

}    // namespace LAMMPS_NS
#endif
