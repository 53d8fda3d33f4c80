/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// A check of fix cluster/breakmerge: which clusters are tested and want to break, who may merge, and what is to be carried out.

#ifndef LMP_EVENT_CHECK_H
#define LMP_EVENT_CHECK_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "carried_values.h"
#include "census.h"
#include "cluster_columns.h"
#include "cluster_walls.h"
#include "contact_source.h"
#include "contact_sums.h"
#include "crowd.h"
#include "event.h"
#include "halo.h"
#include "size_check.h"

#include <memory>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class EventCheck : protected EnginePointers {
 public:
  EventCheck(class LAMMPS *lmp, const BreakMergeSettings &, const ClusterColumns &, ContactSource &, Census &,
             Halo &, int groupbit);

  void init(const std::string &me, Requirements &);
  void make_lattices();    // once their size is known to be bounded
  void make_cells(class Fix *owner) { sizes.make_cells(owner); }
  CellAverages *cells() { return sizes.cells(); }
  void measure();    // contacts and stable sizes, as they are now; ghosts must have moved along

  bool plan(bigint step);    // collective, after measure(): is there anything to be carried out, on any rank?
  void forget();             // what was planned
  const CarriedValues &carried() const { return carried_by_clusters; }
  const std::vector<Event> &events() const { return to_do; }
  const std::vector<int> &dying() const { return vanishing; }    // owned clusters that vanish in merges

 private:
  const BreakMergeSettings &settings;
  const ClusterColumns &columns;
  ContactSource &pairs;
  Census &census;
  Halo &halo;
  int groupbit;
  ContactSums contacts;
  SizeCheck sizes;
  ClusterWalls walls;
  CarriedValues carried_by_clusters;
  MotionOfOthers others;    // whose clusters take no part
  std::unique_ptr<ClusterDEM::Lattices> lattices;
  std::vector<Event> to_do;
  std::vector<int> vanishing;

  using Breakups = std::vector<std::pair<int, ClusterDEM::BreakPlan>>;
  void note_forces();
  bool tested(int i);
  Breakups breakups();
  void remember_postponed(const Breakups &);
  Crowd crowd() const;
  std::vector<Touch> touches() const;
  void note_events();
  void note_contacts();
  void note_spin(const Event &);
};

}    // namespace LAMMPS_NS
#endif
