/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// One break, or one merge; a refused merge that breaks is both.

#ifndef LMP_EVENT_H
#define LMP_EVENT_H

#include "model/breakup.h"
#include "model/merging.h"
#include "model/placement.h"

#include <vector>

namespace LAMMPS_NS {

struct Event {
  int i = -1;           // the owned cluster that leads: the parent, or the one with the lower ID
  int j = -1;           // its partner, owned or ghost; none if negative
  int particles = 0;    // in all
  ClusterDEM::BreakPlan plan;
  ClusterDEM::Body body = {};     // parent, or both combined
  ClusterDEM::Vec3 omega = {};    // of the merged cluster
  ClusterDEM::Placement placement;
  double reach = 0.0;             // the room that it may take: a radius around the body
  double energy_lost = 0.0;       // kinetic energy that the merge takes out
  double energy_born = 0.0;       // elastic energy that the merged cluster puts in
  double energy_after = 0.0;      // that its contacts hold
  std::vector<double> carried;    // values of the merged cluster (carried_values.h)

  bool merges() const { return j >= 0; }
  bool breaks() const { return plan.is_event(); }
};

}    // namespace LAMMPS_NS
#endif
