/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Which breaks and merges happen at a check, agreed across ranks: candidates, partners, room, and who proceeds. Plain arrays
// and a halo go in, events come out; no engine.
//
// The result is as if all candidates went one after the other by ascending ID, each finding its room among the clusters there
// are and the rooms taken before it. Ranks settle it in rounds: a candidate is settled once all with lower IDs are whose room
// might meet its own.

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

  void propose_break(int i, const ClusterDEM::BreakPlan &);    // that owned cluster i wants
  void propose_merges(const std::vector<Touch> &);             // collective: pairs among these contacts
  bool any_proposed() { return halo.anywhere(!candidates.empty()); }
  void settle();    // collective: who proceeds

  const std::vector<Event> &events() const { return proceeding; }    // led by owned clusters, by ascending ID
  const std::vector<int> &dying() const { return vanishing; }        // owned partners of them
  int deferred() const { return postponed + shifted; }
  int rounds() const { return rounds_; }

 private:
  Crowd &crowd;
  const PlanRules &rules;
  Halo &halo;
  MergePartners partners;
  bool merging;
  std::vector<Event> candidates, proceeding;
  std::vector<int> vanishing;
  int postponed, shifted, rounds_;

  // The room of a candidate, told to all who see the cluster that leads it.
  enum State { NONE, OPEN, PROCEEDS, WAITS };
  struct Room {
    int state = NONE;
    double radius = 0.0;            // that it may take, while it is open; that it takes
    ClusterDEM::Vec3 shift = {};    // of its centre from the cluster that leads
  };
  std::vector<Room> rooms;
  // what may be in the way of a candidate: clusters, and the leaders of candidates with lower IDs
  struct Neighbors {
    std::vector<int> clusters, rivals;
  };

  void open_rooms();
  std::vector<Neighbors> find_neighbors() const;
  bool settle_those_that_can(const std::vector<Neighbors> &);
  void settle_one(Event &, const Neighbors &);
  void place_fragments(Event &, const Neighbors &) const;
  void place_merged(Event &, const Neighbors &) const;
  ClusterDEM::Vec3 centre(int leader) const;
  void find_dying();
};

}    // namespace LAMMPS_NS
#endif
