/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_cluster_timestep.h"

#include "fix_cluster_breakmerge.h"
#include "pair_gran_cluster.h"
#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

// Energy below this share of the largest in a run is that of rounded positions.
static constexpr double ROUNDING = 1.0e-12;

/* ---------------------------------------------------------------------- */

FixClusterTimestep::FixClusterTimestep(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), contact_factor(CONTACT_PI / 5.0), stiffness(0.0), stiffness_given(false),
    overlap_limit(1.0), energy_test(true), tolerance(1.0e-6), kinetic(false), predict(true), floor_given(0.0),
    pairs(lmp), pair(nullptr), breakmerge(nullptr), motion{}, range(0.0), fastest(0.0), gain(0.0),
    acceleration_at_look(0.0), looks_ago(0), look_due(true), overlap_bound(INFINITY), test_due(false),
    repeating(false), moved(0.0), kinetic_mine(0.0), energy_all(0.0), most_energy(0.0),
    restless_all{INFINITY, 0.0}, recent_error(0.0), saved(-1), saved_forces(false), elastic_before(0.0), count{},
    worst_overlap(-INFINITY), last_error(0.0), worst_error(0.0)
{
  time_depend = 1;
  restart_global = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extscalar = extvector = 0;

  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} requires atom style sphere or cluster: clusters have a diameter and a mass", style);
  if (igroup)
    error->all(FLERR, 1, "Illegal fix {} group: {} (must be all: all clusters take the same step)", style, arg[1]);

  StyleArguments args(lmp, narg, arg, 3);
  step.most = args.positive("DT_MAX", "time");
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "contact") {
      contact_factor = 0.0;
      if (args.next_is("off")) args.word(keyword);
      else contact_factor = args.positive(keyword, "off, or a share of sqrt(m/k_n)");
    } else if (keyword == "stiffness") {
      stiffness = args.positive(keyword, "force/length");
      stiffness_given = true;
    } else if (keyword == "overlap") overlap_limit = args.within(keyword, 1.0e-6, 1.0e6);
    else if (keyword == "energy") {
      energy_test = !args.next_is("off");
      if (energy_test) tolerance = args.positive(keyword, "off, or a share of the energy");
      else args.word(keyword);
    } else if (keyword == "test") kinetic = args.choice(keyword, {"balance", "kinetic"}) == 1;
    else if (keyword == "floor") {
      floor_given = args.positive(keyword, "time");
      if (floor_given > step.most) args.refuse(keyword, fmt::format("at most DT_MAX = {}", step.most));
    } else if (keyword == "retries") step.retries = args.integer(keyword, 1);
    else if (keyword == "predict") predict = args.yes(keyword);
    else args.unknown_keyword();
  }
  step.start(step.most);
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

void FixClusterTimestep::find_pair()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  pairs.find(me, groupbit, 0.0);
  pair = dynamic_cast<PairGranCluster *>(force->pair_match("gran/cluster", 1));
  if (pair && !stiffness_given) stiffness = pair->contact_law().k_n;
  if (!pair && energy_test)
    error->all(FLERR,
               "{}: the energy test needs pair style gran/cluster, which knows the energy stored in its springs; "
               "pair style {} does not: use 'energy off'",
               me, force->pair_style);
  if (contact_factor > 0.0 && !(stiffness > 0.0))
    error->all(FLERR,
               "{}: the contact bound needs the stiffness k_n of pair style {}: add 'stiffness K_N' "
               "[force/length], or 'contact off'",
               me, force->pair_style);
  if (pair) pair->keep_undo(energy_test);
}

/* ----------------------------------------------------------------------
   other fixes have not added their forces yet: f holds those of contacts
------------------------------------------------------------------------- */

void FixClusterTimestep::setup(int)
{
  overlap_bound = INFINITY;    // whoever set up this run may have moved clusters
  moved = INFINITY;
  recent_error = 0.0;
  restless_all = {INFINITY, 0.0};
  most_energy = 0.0;
  look_due = true;
  saved = -1;
  find_smallest();
  if (!energy_test) return;
  collect_pushed();
  pushed_before.swap(pushed);
  elastic_before = pair->elastic_energy();
}

/* ----------------------------------------------------------------------
   choose the step before anything moves
------------------------------------------------------------------------- */

void FixClusterTimestep::initial_integrate(int)
{
  if (repeating) return;
  saved = -1;
  observe();
  set_step(choose_step());
  if (energy_test) note_start();
  const bool prepared = energy_test && may_be_rejected();
  if (test_due || prepared) save(prepared);
}

/* ----------------------------------------------------------------------
   clusters have drifted: where one would go too deep into another, the drift is undone and done again with
   half of the step, before lists, events and contact history know of it
------------------------------------------------------------------------- */

void FixClusterTimestep::post_integrate()
{
  const double approach = (motion.closing + update->dt * motion.acceleration) * update->dt / motion.smallest;
  if (!test_due) {
    overlap_bound = std::max(0.0, overlap_bound) + approach;
    return;
  }
  for (int halvings = 0;; halvings++) {
    comm->forward_comm();    // clusters have moved, their ghosts have not
    const double way = (motion.closing + update->dt * motion.acceleration) * update->dt;
    const double passing = way / motion.smallest;
    const auto after = pairs.survey(overlap_limit, way, update->dt);
    if (after.deepest < overlap_limit && passing < overlap_limit) {
      overlap_bound = after.deepest;
      worst_overlap = std::max(worst_overlap, after.deepest);
      return;
    }
    count[BY_OVERLAP]++;
    const auto met = pairs.meeting(after.my_deepest, after.deepest);
    if (halvings >= 2 && after.deepest >= overlap_limit && too_soft(met)) stop_too_soft(met, true);
    step.taken(update->dt);
    if (!step.halve()) stop_too_soft(met, true);
    drift_again();
  }
}

/* ---------------------------------------------------------------------- */

void FixClusterTimestep::drift_again()
{
  restore_positions();
  set_step(step.now());
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
    look_due = true;
    find_smallest();
    if (changed_clusters()) overlap_bound = INFINITY;
  }
  if (energy_test) collect_pushed();
}

/* ----------------------------------------------------------------------
   the verdict on the whole step
------------------------------------------------------------------------- */

void FixClusterTimestep::end_of_step()
{
  if (!energy_test) {
    step.accept(0.0);
    return;
  }
  // where clusters changed places, or a check remembers what it saw, a step is neither tested nor taken back
  if (neighbor->ago == 0 || (breakmerge && breakmerge->remembers(update->ntimestep))) {
    count[UNTESTED]++;
    last_error = 0.0;
    const auto &restless = pair->restlessness();
    double mine[2] = {restless.swing, restless.creep}, all[2];
    MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
    restless_all = {all[0], all[1]};
    pushed_before.swap(pushed);
    elastic_before = pair->elastic_energy();
    return;
  }

  const double created = kinetic ? kinetic_energy() - kinetic_mine
                                 : contact_work() + pair->elastic_energy() - elastic_before;
  const double mine[4] = {created, kinetic ? kinetic_mine : kinetic_mine + elastic_before,
                          pair->restlessness().swing, pair->restlessness().creep};
  double all[4];
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_SUM, world);
  most_energy = std::max(most_energy, all[1]);
  const double relative = relative_creation(all[0] - ROUNDING * most_energy, all[1]);
  const bool too_much = !(relative <= tolerance);
  if (too_much && saved_forces && saved >= 0) {
    count[BY_ENERGY]++;
    step.taken(update->dt);
    take_back();
    if (!step.halve()) stop_energy(relative);
    return;
  }
  if (too_much) {    // nobody expected it, so that the state was not kept
    count[LET_PASS]++;
    step.taken(update->dt);
    step.halve();
  } else step.accept(relative / tolerance);
  energy_all = all[1];
  restless_all = {all[2], all[3]};
  last_error = relative;
  worst_error = std::max(worst_error, relative);
  recent_error = std::max(relative / tolerance, 0.8 * recent_error);
  pushed_before.swap(pushed);
  elastic_before = pair->elastic_energy();
}

/* ---------------------------------------------------------------------- */

static constexpr int NSAVED = 4 + 4;

void FixClusterTimestep::write_restart(FILE *fp)
{
  if (comm->me) return;
  const double list[NSAVED] = {step.now(),        worst_overlap,     last_error,        worst_error,
                               (double) count[0], (double) count[1], (double) count[2], (double) count[3]};
  const int size = sizeof(list);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list, sizeof(double), NSAVED, fp);
}

void FixClusterTimestep::restart(char *buf)
{
  double list[NSAVED];
  memcpy(list, buf, sizeof(list));
  step.start(list[0]);
  worst_overlap = list[1];
  last_error = list[2];
  worst_error = list[3];
  for (int k = 0; k < NCOUNTS; k++) count[k] = static_cast<bigint>(list[4 + k]);
}

/* ---------------------------------------------------------------------- */

double FixClusterTimestep::compute_scalar()
{
  return update->dt;
}

/* ----------------------------------------------------------------------
   step, rejections by overlap, by energy, steps untested, overlap now, worst overlap accepted, energy error of the
   last step, worst accepted, steps let pass
------------------------------------------------------------------------- */

double FixClusterTimestep::compute_vector(int n)
{
  switch (n) {
    case 0:
      return update->dt;
    case 1:
    case 2:
    case 3:
      return static_cast<double>(count[n - 1]);
    case 4:
      return std::max(0.0, pairs.survey(overlap_limit, 0.0).deepest);
    case 5:
      return std::max(0.0, worst_overlap);
    case 6:
      return last_error;
    case 7:
      return worst_error;
    default:
      return static_cast<double>(count[LET_PASS]);
  }
}

/* ---------------------------------------------------------------------- */

double FixClusterTimestep::memory_usage()
{
  double bytes = 0.0;
  for (const auto *kept : {&x_before, &v_before, &f_before, &omega_before, &torque_before})
    bytes += (double) kept->capacity() * sizeof(double);
  return bytes + (double) (pushed.capacity() + pushed_before.capacity()) * sizeof(Pushed);
}
