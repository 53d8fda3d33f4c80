/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// How large the atoms of each type may be: clusters of the group as large as the limits allow, others as large as they are. All
// cutoffs are made for these.

#ifndef LMP_LARGEST_DIAMETERS_H
#define LMP_LARGEST_DIAMETERS_H

#include "engine.h"

#include "model/cluster_kinds.h"

#include <vector>

namespace LAMMPS_NS {

class LargestDiameters : protected EnginePointers {
 public:
  LargestDiameters(class LAMMPS *lmp, const ClusterDEM::ClusterKinds &k, int group) :
      EnginePointers(lmp), kinds(k), groupbit(group)
  {
  }

  bool find();    // collective: true if the answers below are not those of before

  bool in_group(int type) const { return clusters[type] > 0; }    // are there clusters of this type?
  bool group_is_empty() const;
  double outside(int type) const
  {
    return diameters[type];
  }    // of atoms that are not in the group; 0: there are none
  double of(int type) const;            // of both; 0: there are none
  bool may_meet(int a, int b) const;    // a type may have one atom alone

 private:
  const ClusterDEM::ClusterKinds &kinds;
  const int groupbit;
  std::vector<int> clusters, others;    // of each type: 0, 1, or 2 for more
  std::vector<double> diameters;
};

}    // namespace LAMMPS_NS
#endif
