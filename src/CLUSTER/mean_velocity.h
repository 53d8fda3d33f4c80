/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The mean velocity of the gas by component: numbers, equal-style or atom-style variables. A variable may ask for anything,
// also for what these fixes themselves computed last, and for computes that keep their answer for the rest of the step: so
// variables are evaluated once per step, after clusters have moved to their ranks, and before anything of the step is reset.

#ifndef LMP_MEAN_VELOCITY_H
#define LMP_MEAN_VELOCITY_H

#include "engine.h"

#include "cluster_table.h"
#include "model/vector3.h"

#include <string>

namespace LAMMPS_NS {
class StyleArguments;

class MeanVelocity : protected EnginePointers {
 public:
  MeanVelocity(class LAMMPS *lmp) : EnginePointers(lmp), of_atoms(nullptr), fresh(false) {}

  void parse(StyleArguments &);
  void add_columns(ClusterTable &);
  void init(const std::string &me);    // finds the variables; `me` is the fix in messages

  bool any_variable() const;
  void evaluate(const std::string &me, int igroup);
  void evaluate_if_never(const std::string &me, int igroup);
  void ask_for_next_step() const;    // computes that the variables need must be ready then

  double at(int i, int axis) const
  {
    return components[axis].per_atom ? (*of_atoms)[i][axis] : components[axis].value;
  }

 private:
  struct Component {
    double value = 0.0;
    std::string variable;
    int index = -1;
    bool per_atom = false;
  } components[3];
  ClusterTable::Values<ClusterDEM::Vec3> *of_atoms;    // as last evaluated; newborns have what their parent had
  bool fresh;                                          // evaluated since init()
};

}    // namespace LAMMPS_NS
#endif
