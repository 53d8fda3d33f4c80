/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The step that the bounds allow, and whether it could be taken back.

#include "fix_cluster_timestep.h"

#include "fix_cluster_breakmerge.h"

#include "comm.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ----------------------------------------------------------------------
   depth_bound grows by the fastest approach of any two clusters in each step; only when it reaches the limit are the
   pairs themselves looked at
------------------------------------------------------------------------- */

double FixClusterTimestep::choose_step()
{
  double ceiling = step.most;
  if (settings.contact_factor > 0.0)
    ceiling = std::min(ceiling, contact_step(settings.contact_factor, motion.lightest(), stiffness()));
  step.floor = settings.floor > 0.0 ? std::min(settings.floor, ceiling) : std::ldexp(ceiling, -step.retries);
  double dt = std::min(step.now(), ceiling);
  auto too_deep = [&] {
    const double way = motion.bounds().approach_within(dt);
    return !(depth_after(depth_bound, way, motion.smallest()) < settings.overlap_limit);
  };

  if (too_deep() && !motion.looked_just_now()) look();
  if (too_deep()) {
    comm->forward_comm();    // ghosts still have the velocities of half a step ago
    const auto now = survey.look(settings.overlap_limit, motion.bounds().approach_within(dt));
    depth_bound = now.deepest;
    worst_depth = std::max(worst_depth, now.deepest);
    if (settings.predict) dt = predict(dt, now);
  }
  test_due = too_deep();
  if (settings.energy_test && cannot_be_taken_back()) dt = step.cautious(dt, energy.recent());
  moved += motion.bounds().way_within(dt);
  return dt;
}

double FixClusterTimestep::predict(double wanted, const ContactSurvey::Found &now)
{
  const double dt = predicted_step(wanted, settings.overlap_limit, motion.smallest(),
                                   motion.bounds().closing_within(wanted), now.soonest);
  if (dt < 0.25 * wanted) {    // two halvings
    const auto met = survey.soonest(now);
    if (met.approach.overlap > 0.0 && too_soft(met)) stop_too_soft(met, false);
  }
  return dt < step.floor ? std::min(wanted, step.floor) : dt;
}

/* ----------------------------------------------------------------------
   may the coming step rebuild the lists or hold events?
------------------------------------------------------------------------- */

bool FixClusterTimestep::cannot_be_taken_back() const
{
  const bigint now = update->ntimestep;
  if (breakmerge && now % breakmerge->nevery == 0) return true;
  if (output->next_restart == now) return true;    // the lists are rebuilt before a restart file
  for (const auto &fix : modify->get_fix_list())
    if (fix->force_reneighbor && fix->next_reneighbor == now) return true;
  return 2.0 * (moved + motion.bounds().way_without_force(step.now())) >= neighbor->skin;
}

/* ----------------------------------------------------------------------
   did this step's rebuild come with new or other clusters?
------------------------------------------------------------------------- */

bool FixClusterTimestep::changed_clusters() const
{
  for (const auto &fix : modify->get_fix_list())
    if (fix->force_reneighbor && fix->next_reneighbor == update->ntimestep) return true;
  return false;
}
