/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What LIGGGHTS wants of fix cluster/breakmerge beyond what LAMMPS does: radii that grow are announced, clusters
// have a density, contact forces are stored by the pair style.

#ifdef FIX_CLASS
// clang-format off
FixStyle(cluster/breakmerge,FixClusterBreakMergeLiggghts)
// clang-format on
#else

#ifndef LMP_FIX_CLUSTER_BREAKMERGE_LIGGGHTS_H
#define LMP_FIX_CLUSTER_BREAKMERGE_LIGGGHTS_H

#include "fix_cluster_breakmerge.h"

namespace LAMMPS_NS {

class FixClusterBreakMergeLiggghts : public FixClusterBreakMerge {
 public:
  FixClusterBreakMergeLiggghts(class LAMMPS *, int, char **);
  void post_create() override;
  void init() override;
  void pre_exchange() override;
  double max_rad(int) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
