/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Which breaks and merges happen at a check, agreed across ranks: candidates, partners, room, and who proceeds. Plain arrays
// and a halo go in, events come out; no engine.

#ifndef LMP_EVENT_PLAN_H
#define LMP_EVENT_PLAN_H

#include "crowd.h"
#include "event.h"
#include "halo.h"
#include "merge_partners.h"
#include "plan_rules.h"

#include <vector>

namespace LAMMPS_NS {

class EventPlan {
 public:
  EventPlan(Crowd &, const PlanRules &, Halo &);

  // A breakup that owned cluster i wants.
  void propose_break(int i, const ClusterDEM::BreakPlan &);
  // collective: pairs among these contacts that merge
  void propose_merges(const std::vector<Touch> &, const MergePartners::Stiffness &);
  bool any_proposed() { return halo.anywhere(!candidates.empty()); }
  // collective: who proceeds
  void settle();

  const std::vector<Event> &events() const { return proceeding; }    // led by owned clusters
  const std::vector<int> &dying() const { return vanishing; }        // owned partners of them
  int deferred() const { return postponed + shifted; }

 private:
  Crowd &crowd;
  const PlanRules &rules;
  Halo &halo;
  MergePartners partners;
  bool merging;
  std::vector<char> taken;    // by a breakup
  std::vector<Event> candidates, proceeding;
  std::vector<int> vanishing;
  int postponed, shifted;

  std::vector<std::vector<ClusterDEM::Obstacle>> find_obstacles();
  void place(Event &, const std::vector<ClusterDEM::Obstacle> &) const;
  void place_fragments(Event &, const std::vector<ClusterDEM::Obstacle> &) const;
  void place_merged(Event &, const std::vector<ClusterDEM::Obstacle> &) const;
  void arbitrate();
  void find_dying(const std::vector<char> &proceeds);
};

}    // namespace LAMMPS_NS
#endif
