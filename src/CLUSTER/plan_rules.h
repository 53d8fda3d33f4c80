/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the plan of a check goes by.

#ifndef LMP_PLAN_RULES_H
#define LMP_PLAN_RULES_H

#include "model/cluster_kinds.h"
#include "model/placement.h"

#include <cstdint>

namespace LAMMPS_NS {

struct PlanRules {
  const ClusterDEM::ClusterKinds *kinds = nullptr;
  const ClusterDEM::Lattices *lattices = nullptr;
  double merge_tolerance = 0.01;
  bool break_refused = false;
  double claim = 0.0;
  double spacing = 2.0;
  bool planar = true;        // fragments are placed in the xz plane
  std::int64_t check = 0;    // its number

  int fewest() const { return kinds->limits.lo; }
};

}    // namespace LAMMPS_NS
#endif
