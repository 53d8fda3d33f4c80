/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The events themselves: clusters change, are born and vanish, before atoms migrate.

#ifndef LMP_EVENT_APPLY_H
#define LMP_EVENT_APPLY_H

#include "engine.h"

#include "carried_values.h"
#include "cluster_columns.h"
#include "event.h"
#include "model/cluster_kinds.h"
#include "newborn_tags.h"

#include <vector>

namespace LAMMPS_NS {

class EventApply : protected EnginePointers {
 public:
  EventApply(class LAMMPS *lmp, const ClusterDEM::ClusterKinds &k, const ClusterColumns &c, NewbornTags &t,
             const CarriedValues &v) : EnginePointers(lmp), kinds(k), columns(c), tags(t), carried(v)
  {
  }

  void init();    // who in this scene remembers contacts
  // collective: all events of this check; `dying` are owned clusters that vanish in merges
  void carry_out(const std::vector<Event> &, std::vector<int> dying);

 private:
  const ClusterDEM::ClusterKinds &kinds;
  const ClusterColumns &columns;
  NewbornTags &tags;
  const CarriedValues &carried;
  std::vector<class Fix *> contact_memories;

  void become(int i, int n, const ClusterDEM::Vec3 &x, const ClusterDEM::Vec3 &v);
  void create_fragments(const Event &, tagint first);
  int copy_of(int parent);
  void remove(std::vector<int> &dying);
};

}    // namespace LAMMPS_NS
#endif
