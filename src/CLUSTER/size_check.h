/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The stable size of every cluster at a check, from the gas, the contacts and the averages of cells: Eqs. (1) and (2).

#ifndef LMP_SIZE_CHECK_H
#define LMP_SIZE_CHECK_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "cell_averages.h"
#include "cluster_columns.h"
#include "contact_sums.h"
#include "model/decisive_terms.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixDragCluster;

class SizeCheck : protected EnginePointers {
 public:
  SizeCheck(class LAMMPS *lmp, const BreakMergeSettings &, const ClusterColumns &, int groupbit);

  void init(const std::string &me);     // the gas, the constants of each kind; stops where they do not fit
  void make_cells(class Fix *owner);    // averages, if any reading asks for them
  CellAverages *cells() { return averages.get(); }

  void measure(const ContactSums &);
  ClusterDEM::StableSize stable(int i) const { return {columns.stable_diameter(i), n_stable[i]}; }
  const ClusterDEM::SizeRule &rule(int kind) const { return rules[kind]; }

  bool knows_drag() const { return drag != nullptr; }
  double drag_force(int i) const;    // on owned cluster i, as last computed

 private:
  const SizeSettings &settings;
  const ClusterDEM::ClusterKinds &kinds;
  const ClusterColumns &columns;
  int groupbit;
  FixDragCluster *drag;    // whose gas and drag are asked
  std::unique_ptr<CellAverages> averages;
  std::vector<ClusterDEM::SizeRule> rules;    // by kind
  std::vector<double> u_mf;                   // by kind, in a gas of uniform properties
  std::vector<int> n_stable;

  bool local_umf() const;
  double umf_in(const ClusterDEM::Gas &, const ClusterDEM::ClusterGeometry &) const;
  void average_cells();
  double gas_power(int i, const ClusterDEM::ClusterGeometry &);
  double fluidization_power(int i, int kind);
};

}    // namespace LAMMPS_NS
#endif
