/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_cluster_timestep.h"

#include "fix_cluster_breakmerge.h"
#include "pair_gran_cluster.h"
#include "step_scene.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

FixClusterTimestep::FixClusterTimestep(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), settings(lmp, narg, arg), contacts(lmp), survey(lmp, contacts), clock(lmp), state(lmp),
    motion(lmp, fmt::format("Fix {} {}", style, id)), energy(lmp, settings.tolerance, settings.kinetic),
    pair(nullptr), breakmerge(nullptr), depth_bound(INFINITY), moved(0.0), test_due(false), repeating(false),
    count{}, worst_depth(-INFINITY)
{
  time_depend = 1;
  restart_global = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 10;
  global_freq = 1;
  extscalar = extvector = 0;

  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} requires atom style sphere or cluster: clusters have a diameter and a mass", style);
  if (igroup)
    error->all(FLERR, 1, "Illegal fix {} group: {} (must be all: all clusters take the same step)", style, arg[1]);
  step.most = settings.most;
  step.retries = settings.retries;
  step.start(settings.most);
}

/* ---------------------------------------------------------------------- */

int FixClusterTimestep::setmask()
{
  return INITIAL_INTEGRATE | POST_INTEGRATE | POST_FORCE | END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixClusterTimestep::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix {} {} does not support run_style respa: use run_style verlet", style, id);
  if (modify->get_fix_by_style("^cluster/timestep").size() > 1)
    error->all(FLERR, "Fix {} {}: only one fix cluster/timestep at a time", style, id);
  if (!modify->get_fix_by_style("^dt/reset").empty())
    error->all(FLERR, "Fix {} {}: fix dt/reset changes the same time step", style, id);
  check_order();
  check_fixes();
  find_pair();
  const auto fixes = modify->get_fix_by_style("^cluster/breakmerge");
  breakmerge = fixes.empty() ? nullptr : dynamic_cast<FixClusterBreakMerge *>(fixes[0]);
}

/* ----------------------------------------------------------------------
   the state is kept before any other fix moves a cluster, and contact forces are told from others by coming first
------------------------------------------------------------------------- */

void FixClusterTimestep::check_order() const
{
  const auto &fixes = modify->get_fix_list();
  for (std::size_t k = 0; k < fixes.size() && fixes[k] != this; k++)
    if (modify->fmask[k] & (INITIAL_INTEGRATE | POST_INTEGRATE | POST_FORCE))
      error->all(FLERR,
                 "Fix {} {} must be defined before fix {} ({}), which moves clusters or adds forces: it must keep "
                 "the state of each step first",
                 style, id, fixes[k]->id, fixes[k]->style);
}

/* ---------------------------------------------------------------------- */

void FixClusterTimestep::check_fixes() const
{
  const auto unfit = unfit_fixes(lmp, settings.energy_test);
  if (unfit.empty()) return;
  std::string all;
  for (const auto &fix : unfit) all += (all.empty() ? "" : "; ") + fix;
  error->all(FLERR, "Fix {} {} changes and repeats time steps, which does not go with {}", style, id, all);
}

/* ----------------------------------------------------------------------
   the law of pair gran/cluster is that of all contacts, or it is not used
------------------------------------------------------------------------- */

void FixClusterTimestep::find_pair()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  contacts.find(me);
  auto *ours = dynamic_cast<PairGranCluster *>(force->pair_match("gran/cluster", 1));
  const auto others = other_forces(lmp);
  pair = others.empty() ? ours : nullptr;
  if (!pair && settings.energy_test) {
    std::string all;
    for (const auto &other : others) all += (all.empty() ? "" : " and ") + other;
    error->all(
        FLERR,
        "{}: the energy test needs pair style gran/cluster, which knows the energy stored in its springs, for "
        "all forces between clusters; {} {} not: use 'energy off'",
        me, all, others.size() > 1 ? "do" : "does");
  }
  if (settings.contact_factor > 0.0 && !(stiffness() > 0.0))
    error->all(FLERR,
               "{}: the contact bound needs the stiffness k_n of pair style {}: add 'stiffness K_N' "
               "[force/length], or 'contact off'",
               me, force->pair_style);
  if (ours) ours->keep_undo(settings.energy_test);
  motion.set_pair(pair);
}

double FixClusterTimestep::stiffness() const
{
  if (settings.stiffness > 0.0) return settings.stiffness;
  return pair ? pair->contact_law().k_n : 0.0;
}

/* ----------------------------------------------------------------------
   other fixes have not added their forces yet: f holds those of contacts
------------------------------------------------------------------------- */

void FixClusterTimestep::setup(int)
{
  depth_bound = INFINITY;    // whoever set up this run may have moved clusters
  moved = INFINITY;
  motion.must_look();
  motion.weigh();
  state.forget();
  if (settings.energy_test) energy.start_run(pair);
}

/* ----------------------------------------------------------------------
   choose the step before anything moves
------------------------------------------------------------------------- */

void FixClusterTimestep::initial_integrate(int)
{
  if (repeating) return;
  state.forget();
  if (motion.look_due() || settings.kinetic) look();
  else motion.reckon();
  clock.set(choose_step());
  if (settings.energy_test) energy.note_start();
  const bool prepared = settings.energy_test && energy.may_fail(update->dt, stiffness(), motion);
  if (test_due || prepared) state.keep(prepared);
}

void FixClusterTimestep::look()
{
  motion.look();
  if (settings.energy_test) energy.note_kinetic();
}

/* ----------------------------------------------------------------------
   clusters have drifted: where one would go too deep into another, the drift is undone and done again with
   half of the step, before lists, events and contact history know of it
------------------------------------------------------------------------- */

void FixClusterTimestep::post_integrate()
{
  const double limit = settings.overlap_limit;
  if (!test_due) {
    depth_bound = depth_after(depth_bound, motion.bounds().approach_within(update->dt), motion.smallest());
    return;
  }
  for (int halvings = 0;; halvings++) {
    comm->forward_comm();    // clusters have moved, their ghosts have not
    const double way = motion.bounds().approach_within(update->dt);
    const auto after = survey.look(limit, way, update->dt);
    if (after.deepest < limit && depth_after(0.0, way, motion.smallest()) < limit) {
      depth_bound = after.deepest;
      worst_depth = std::max(worst_depth, after.deepest);
      return;
    }
    count[BY_OVERLAP]++;
    const auto met = survey.deepest(after);
    if (halvings >= 2 && after.deepest >= limit && too_soft(met)) stop_too_soft(met, true);
    step.taken(update->dt);
    if (!step.halve()) stop_too_soft(met, true);
    drift_again();
  }
}

/* ---------------------------------------------------------------------- */

void FixClusterTimestep::drift_again()
{
  state.put_back_motion();
  clock.set(step.now());
  repeating = true;
  modify->initial_integrate(0);
  repeating = false;
}

/* ----------------------------------------------------------------------
   the first fix to see the forces: pair forces are in, others are not
------------------------------------------------------------------------- */

void FixClusterTimestep::post_force(int)
{
  if (neighbor->ago == 0) {
    moved = 0.0;
    motion.must_look();
    motion.weigh();
    if (changed_clusters()) depth_bound = INFINITY;
  }
  if (settings.energy_test) energy.note_contacts();
}

/* ----------------------------------------------------------------------
   the verdict on the whole step
------------------------------------------------------------------------- */

void FixClusterTimestep::end_of_step()
{
  if (!settings.energy_test) {
    step.accept(0.0);
    return;
  }
  // where clusters changed places, or a check remembers what it saw, a step is neither tested nor taken back
  if (neighbor->ago == 0 || (breakmerge && breakmerge->remembers(update->ntimestep))) {
    count[UNTESTED]++;
    energy.go_on_untested();
    return;
  }
  const auto verdict = energy.judge();
  if (verdict.too_much && state.whole()) {
    count[BY_ENERGY]++;
    step.taken(update->dt);
    take_back();
    if (!step.halve()) stop_energy(verdict.created);
    return;
  }
  if (verdict.too_much) {    // nobody expected it, so that the state was not kept
    count[LET_PASS]++;
    step.taken(update->dt);
    step.halve();
  } else step.accept(verdict.created / energy.tolerance());
  energy.accept(verdict);
}

/* ----------------------------------------------------------------------
   as if the step had not been
------------------------------------------------------------------------- */

void FixClusterTimestep::take_back()
{
  state.put_back();
  pair->undo();
  comm->forward_comm();
  depth_bound = INFINITY;
  motion.must_look();
  clock.take_back();
}
