/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_cluster_timestep.h"

#include "fix_cluster_breakmerge.h"
#include "pair_gran_cluster.h"
#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"
#include "write_restart.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

static constexpr double PREDICTED_SHARE = 0.9;    // of the time to the overlap limit
static constexpr int LOOK_EVERY = 8;              // steps between looks at all velocities

/* ---------------------------------------------------------------------- */

FixClusterTimestep::FixClusterTimestep(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), contact_factor(CONTACT_PI / 5.0), stiffness(0.0), stiffness_given(false), overlap_limit(1.0),
    energy_test(true), tolerance(1.0e-6), kinetic(false), predict(true), floor_given(0.0), pairs(lmp), pair(nullptr),
    breakmerge(nullptr), motion{}, range(0.0), fastest(0.0), gain(0.0), looks_ago(0), overlap_bound(INFINITY), test_due(false),
    repeating(false), moved(0.0), kinetic_mine(0.0), energy_all(0.0), restless_all{INFINITY, 0.0}, recent_error(0.0), saved(-1), saved_forces(false), elastic_before(0.0), count{}, worst_overlap(-INFINITY),
    last_error(0.0), worst_error(0.0)
{
  time_depend = 1;
  restart_global = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 9;
  global_freq = 1;
  extscalar = extvector = 0;

  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} requires atom style sphere or cluster: clusters have a diameter and a mass", style);
  if (igroup) error->all(FLERR, 1, "Illegal fix {} group: {} (must be all: all clusters take the same step)", style, arg[1]);

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
    } else if (keyword == "overlap")
      overlap_limit = args.positive(keyword, "share of the smaller diameter");
    else if (keyword == "energy") {
      energy_test = !args.next_is("off");
      if (energy_test) tolerance = args.positive(keyword, "off, or a share of the energy");
      else args.word(keyword);
    } else if (keyword == "test")
      kinetic = args.choice(keyword, {"balance", "kinetic"}) == 1;
    else if (keyword == "floor") {
      floor_given = args.positive(keyword, "time");
      if (floor_given > step.most) args.refuse(keyword, fmt::format("at most DT_MAX = {}", step.most));
    } else if (keyword == "retries")
      step.retries = args.integer(keyword, 1);
    else if (keyword == "predict")
      predict = args.yes(keyword);
    else
      args.unknown_keyword();
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
      error->all(FLERR, "Fix {} {} must be defined before fix {} ({}), which moves clusters or adds forces: it must keep "
                 "the state of each step first", style, id, fixes[k]->id, fixes[k]->style);
}

/* ---------------------------------------------------------------------- */

void FixClusterTimestep::find_pair()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  pairs.find(me, groupbit, 0.0);
  pair = dynamic_cast<PairGranCluster *>(force->pair_match("gran/cluster", 1));
  if (pair && !stiffness_given) stiffness = pair->contact_law().k_n;
  if (!pair && energy_test)
    error->all(FLERR, "{}: the energy test needs pair style gran/cluster, which knows the energy stored in its springs; "
               "pair style {} does not: use 'energy off'", me, force->pair_style);
  if (contact_factor > 0.0 && !(stiffness > 0.0))
    error->all(FLERR, "{}: the contact bound needs the stiffness k_n of pair style {}: add 'stiffness K_N' "
               "[force/length], or 'contact off'", me, force->pair_style);
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
  looks_ago = LOOK_EVERY;
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
   Lowest and highest components of n vectors, four vectors at a time so that the processor takes them together.
   False if one is not finite.
------------------------------------------------------------------------- */

static constexpr int LANES = 12;

static bool extremes(double **vectors, int n, double *lowest, double *highest)
{
  double lo[LANES], hi[LANES], sum[LANES] = {0.0};
  std::fill(lo, lo + LANES, INFINITY);
  std::fill(hi, hi + LANES, -INFINITY);
  const double *a = n ? vectors[0] : nullptr;
  const int size = 3 * n, whole = size - size % LANES;
  for (int first = 0; first < whole; first += LANES)
    for (int lane = 0; lane < LANES; lane++) {
      const double value = a[first + lane];
      lo[lane] = value < lo[lane] ? value : lo[lane];
      hi[lane] = value > hi[lane] ? value : hi[lane];
      sum[lane] += value;
    }
  for (int m = whole; m < size; m++) {
    lo[m - whole] = std::min(lo[m - whole], a[m]);
    hi[m - whole] = std::max(hi[m - whole], a[m]);
    sum[m - whole] += a[m];
  }
  bool finite = true;
  for (int lane = 0; lane < LANES; lane++) {
    lowest[lane % 3] = std::min(lowest[lane % 3], lo[lane]);
    highest[lane % 3] = std::max(highest[lane % 3], hi[lane]);
    finite = finite && std::isfinite(sum[lane]);
  }
  return finite;
}

/* ----------------------------------------------------------------------
   What bounds the step, on all ranks. All velocities are looked at now and then; in between their range grows by no more
   than the largest force on the lightest cluster times the step.
------------------------------------------------------------------------- */

void FixClusterTimestep::observe()
{
  if (++looks_ago >= LOOK_EVERY || kinetic) {
    look();
    return;
  }
  double lowest[3], highest[3], mine[4], all[4];
  std::fill(lowest, lowest + 3, INFINITY);
  std::fill(highest, highest + 3, -INFINITY);
  mine[3] = extremes(atom->f, atom->nlocal, lowest, highest) ? 0.0 : 1.0;
  for (int k = 0; k < 3; k++) mine[k] = std::max({0.0, -lowest[k], highest[k]});
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_MAX, world);
  if (all[3] > 0.0) stop_not_finite();
  const double before = motion.acceleration;
  motion.acceleration = force->ftm2v * norm({all[0], all[1], all[2]}) / motion.lightest;
  gain += 0.5 * (before + motion.acceleration) * update->dt;    // of the step before this one
  motion.closing = range + 2.0 * gain;
  motion.speed = fastest + gain;
}

void FixClusterTimestep::look()
{
  const int nlocal = atom->nlocal;
  double lowest[3], highest[3], mine[8], all[8];
  std::fill(lowest, lowest + 3, INFINITY);
  std::fill(highest, highest + 3, -INFINITY);
  bool finite = extremes(atom->v, nlocal, lowest, highest);
  double acceleration_sq = 0.0;
  for (int i = 0; i < nlocal; i++) {
    const Vec3 f = to_vec3(atom->f[i]);
    const double a_sq = dot(f, f) / (atom->rmass[i] * atom->rmass[i]);
    finite = finite && std::isfinite(a_sq);
    acceleration_sq = std::max(acceleration_sq, a_sq);
  }
  for (int k = 0; k < 3; k++) {
    mine[k] = -lowest[k];
    mine[3 + k] = highest[k];
  }
  mine[6] = acceleration_sq;
  mine[7] = finite ? 0.0 : 1.0;
  MPI_Allreduce(mine, all, 8, MPI_DOUBLE, MPI_MAX, world);
  if (all[7] > 0.0) stop_not_finite();

  const bool any = atom->natoms > 0;
  Vec3 width{0.0, 0.0, 0.0}, most = width;
  for (int k = 0; any && k < 3; k++) {
    width[k] = all[k] + all[3 + k];
    most[k] = std::max(all[k], all[3 + k]);
  }
  motion.closing = range = norm(width);
  motion.speed = fastest = norm(most);
  motion.acceleration = force->ftm2v * std::sqrt(all[6]);
  gain = 0.0;
  looks_ago = 0;
  kinetic_mine = kinetic_energy();
}

void FixClusterTimestep::stop_not_finite()
{
  error->all(FLERR, "Fix {} {}: a velocity or force is not finite at step {}", style, id, update->ntimestep - 1);
}

/* ----------------------------------------------------------------------
   could this step create more energy than the tolerance allows? Then its start is kept.
------------------------------------------------------------------------- */

bool FixClusterTimestep::may_be_rejected() const
{
  if (kinetic || recent_error > 0.01) return true;
  return !(possible_creation(update->dt, restless_all, stiffness, motion.lightest, motion.heaviest, motion.closing) <
           tolerance * energy_all);
}

double FixClusterTimestep::kinetic_energy() const
{
  const int nlocal = atom->nlocal;
  const double *v = nlocal ? atom->v[0] : nullptr, *rmass = atom->rmass;
  double sum = 0.0;
  for (int i = 0; i < nlocal; i++)
    sum += rmass[i] * (v[3 * i] * v[3 * i] + v[3 * i + 1] * v[3 * i + 1] + v[3 * i + 2] * v[3 * i + 2]);
  return 0.5 * force->mvv2e * sum;
}

/* ----------------------------------------------------------------------
   lightest, heaviest and smallest cluster: they change with the lists alone
------------------------------------------------------------------------- */

void FixClusterTimestep::find_smallest()
{
  double mine[3] = {-INFINITY, 0.0, -INFINITY}, all[3];
  for (int i = 0; i < atom->nlocal; i++) {
    mine[0] = std::max(mine[0], -atom->rmass[i]);
    mine[1] = std::max(mine[1], atom->rmass[i]);
    mine[2] = std::max(mine[2], -atom->radius[i]);
  }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_MAX, world);
  motion.lightest = -all[0];
  motion.heaviest = all[1];
  motion.smallest = -2.0 * all[2];
}

/* ----------------------------------------------------------------------
   the step that the bounds allow. overlap_bound grows by the fastest approach of any two clusters in each step; only
   when it reaches the limit are the pairs themselves looked at.
------------------------------------------------------------------------- */

double FixClusterTimestep::choose_step()
{
  double ceiling = step.most;
  if (contact_factor > 0.0) ceiling = std::min(ceiling, contact_step(contact_factor, motion.lightest, stiffness));
  step.floor = floor_given > 0.0 ? std::min(floor_given, ceiling) : std::ldexp(ceiling, -step.retries);
  double dt = std::min(step.now(), ceiling);
  auto closing = [&] { return motion.closing + dt * motion.acceleration; };
  auto bound_after = [&] { return std::max(0.0, overlap_bound) + closing() * dt / motion.smallest; };

  if (!(bound_after() < overlap_limit) && looks_ago > 0) look();
  if (!(bound_after() < overlap_limit)) {
    comm->forward_comm();    // ghosts still have the velocities of half a step ago
    const auto now = pairs.survey(overlap_limit, closing() * dt);
    overlap_bound = now.deepest;
    worst_overlap = std::max(worst_overlap, now.deepest);
    const double before_prediction = dt;
    if (predict) {
      // no two clusters may pass each other within one step
      if (closing() > 0.0) dt = std::min(dt, 0.5 * overlap_limit * motion.smallest / closing());
      dt = std::min(dt, PREDICTED_SHARE * now.soonest);
      if (dt < 0.25 * before_prediction) {    // two halvings
        const auto met = pairs.meeting(now.my_soonest, now.soonest);
        if (met.overlap > 0.0 && too_soft(met)) stop_too_soft(met, false);
      }
      if (dt < step.floor) dt = std::min(before_prediction, step.floor);
    }
  }
  test_due = !(bound_after() < overlap_limit);
  if (energy_test && cannot_be_taken_back()) dt = step.cautious(dt, recent_error);
  moved += (motion.speed + dt * motion.acceleration) * dt;
  return dt;
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
  return 2.0 * (moved + motion.speed * step.now()) >= neighbor->skin;
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

/* ----------------------------------------------------------------------
   the time that has passed is kept before the step changes
------------------------------------------------------------------------- */

void FixClusterTimestep::set_step(double dt)
{
  if (dt == update->dt) return;
  const bigint last = update->ntimestep - 1;
  if (update->atimestep < last) {
    update->atime += (last - update->atimestep) * update->dt;
    update->atimestep = last;
  }
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  for (const auto &fix : modify->get_fix_list()) fix->reset_dt();
  output->reset_dt();
}

/* ----------------------------------------------------------------------
   state at the start of the step; for the drift alone forces need not be kept
------------------------------------------------------------------------- */

static void keep(std::vector<double> &kept, double **from, int n)
{
  if (kept.size() < 3 * static_cast<std::size_t>(n)) kept.resize(3 * static_cast<std::size_t>(n));
  if (n) memcpy(kept.data(), from[0], 3 * sizeof(double) * n);
}

static void put_back(double **to, const std::vector<double> &kept, int n)
{
  if (n) memcpy(to[0], kept.data(), 3 * sizeof(double) * n);
}

void FixClusterTimestep::save(bool forces)
{
  saved = atom->nlocal;
  saved_forces = forces;
  keep(x_before, atom->x, saved);
  keep(v_before, atom->v, saved);
  if (atom->omega_flag) keep(omega_before, atom->omega, saved);
  if (!forces) return;
  keep(f_before, atom->f, saved);
  if (atom->torque_flag) keep(torque_before, atom->torque, saved);
}

void FixClusterTimestep::restore_positions()
{
  put_back(atom->x, x_before, saved);
  put_back(atom->v, v_before, saved);
  if (atom->omega_flag) put_back(atom->omega, omega_before, saved);
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
   Of pair gran/cluster the largest overlap of an approach is known in closed form; of another pair style a pair that is
   deep in contact and comes nearer after two halvings will not be stopped by a third.
------------------------------------------------------------------------- */

bool FixClusterTimestep::too_soft(const GranularPairs::Meeting &m) const
{
  const double most = overlap_limit * m.smaller;
  if (pair) return pair->contact_law().peak_overlap(m.mass, std::max(0.0, m.overlap), m.closing) >= most;
  return m.overlap > 0.5 * most && m.closing > 0.0;
}

/* ----------------------------------------------------------------------
   the first fix to see the forces: pair forces are in, others are not
------------------------------------------------------------------------- */

void FixClusterTimestep::post_force(int)
{
  if (neighbor->ago == 0) {
    moved = 0.0;
    looks_ago = LOOK_EVERY;
    find_smallest();
    if (changed_clusters()) overlap_bound = INFINITY;
  }
  if (energy_test) collect_pushed();
}

void FixClusterTimestep::collect_pushed()
{
  double **f = atom->f, **v = atom->v, **torque = atom->torque, **omega = atom->omega;
  const bool rotating = atom->torque_flag;
  const Vec3 none{0.0, 0.0, 0.0};
  const int nlocal = atom->nlocal;
  pushed.clear();
  for (int i = 0; i < nlocal; i++)
    if (f[i][0] != 0.0 || f[i][1] != 0.0 || f[i][2] != 0.0)
      pushed.push_back({i, to_vec3(f[i]), rotating ? to_vec3(torque[i]) : none, to_vec3(v[i]),
                        rotating ? to_vec3(omega[i]) : none});
}

void FixClusterTimestep::note_start()
{
  for (Pushed &p : pushed_before) {
    p.v = to_vec3(atom->v[p.i]);
    if (atom->torque_flag) p.omega = to_vec3(atom->omega[p.i]);
  }
}

/* ----------------------------------------------------------------------
   Exact for velocity Verlet: of the gain dt/4 (F + F')(v + v') of each cluster the part of contact forces. A cluster that
   was not pushed before has its omega of the start, and half a step of the other forces in its v.
------------------------------------------------------------------------- */

double FixClusterTimestep::contact_work() const
{
  double **v = atom->v, **f = atom->f, **omega = atom->omega;
  const bool rotating = atom->torque_flag;
  const double half = 0.5 * update->dt * force->ftm2v;
  double sum = 0.0;
  auto add = [&](const Pushed &p, const Vec3 &v_start, const Vec3 &omega_start) {
    sum += dot(p.force, to_vec3(v[p.i]) + v_start);
    if (rotating) sum += dot(p.torque, to_vec3(omega[p.i]) + omega_start);
  };
  for (const Pushed &p : pushed_before) add(p, p.v, p.omega);
  auto before = pushed_before.begin();
  for (const Pushed &p : pushed) {
    while (before != pushed_before.end() && before->i < p.i) ++before;
    if (before != pushed_before.end() && before->i == p.i) add(p, before->v, before->omega);
    else add(p, p.v - (half / atom->rmass[p.i]) * (to_vec3(f[p.i]) - p.force), p.omega);
  }
  return 0.25 * update->dt * sum;
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
  const double relative = relative_creation(all[0], all[1]);
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
  } else
    step.accept(relative / tolerance);
  energy_all = all[1];
  restless_all = {all[2], all[3]};
  last_error = relative;
  worst_error = std::max(worst_error, relative);
  recent_error = std::max(relative / tolerance, 0.8 * recent_error);
  pushed_before.swap(pushed);
  elastic_before = pair->elastic_energy();
}

/* ----------------------------------------------------------------------
   as if the step had not been: its number has passed, its time has not
------------------------------------------------------------------------- */

void FixClusterTimestep::take_back()
{
  restore_positions();
  put_back(atom->f, f_before, saved);
  if (atom->torque_flag) put_back(atom->torque, torque_before, saved);
  pair->undo();
  comm->forward_comm();
  overlap_bound = INFINITY;
  looks_ago = LOOK_EVERY;
  const bigint last = update->ntimestep - 1;
  update->atime += (last - update->atimestep) * update->dt;
  update->atimestep = update->ntimestep;
}

/* ----------------------------------------------------------------------
   nothing is lost: the last good state goes to a restart file before the error
------------------------------------------------------------------------- */

void FixClusterTimestep::stop(const std::string &message, bool drifted)
{
  if (drifted) restore_positions();
  const bigint good = update->ntimestep - 1;
  if (update->atimestep <= good) {
    update->atime += (good - update->atimestep) * update->dt;
    update->atimestep = good;
  }
  update->ntimestep = good;
  const std::string file = fmt::format("{}.{}.restart", id, good);
  domain->pbc();
  WriteRestart writer(lmp);
  writer.multiproc_options(0, 0, nullptr);
  writer.write(file);
  error->all(FLERR, "Fix {} {}: {} The state of step {} is in {}.", style, id, message, good, file);
}

void FixClusterTimestep::stop_too_soft(const GranularPairs::Meeting &m, bool drifted)
{
  if (m.smaller == 0.0)
    stop(fmt::format("clusters approach each other at up to {:.4g} and could pass unseen at the smallest step {:.4g}: allow "
                     "a smaller floor or more retries, or 'predict yes'.", motion.closing, update->dt), drifted);
  const double most = overlap_limit * m.smaller;
  const std::string who = fmt::format("clusters {:.0f} and {:.0f} overlap by {:.4g}, {:.3g} of the smaller diameter {:.4g}, "
                                      "and approach at {:.4g}", m.tags[0], m.tags[1], m.overlap, m.overlap / m.smaller,
                                      m.smaller, m.closing);
  if (!too_soft(m))
    stop(fmt::format("{}, beyond the limit {} at the smallest step {:.4g}: allow a smaller floor or more retries.", who,
                     overlap_limit, update->dt), drifted);
  double enough = stopping_stiffness(m.mass, m.closing, most);
  if (pair) {
    const auto &law = pair->contact_law();
    enough = law.stiffness_for(law.peak_overlap(m.mass, std::max(0.0, m.overlap), m.closing), most);
  }
  stop(fmt::format("the contact spring is too soft, no smaller step helps: {}; k_n of at least {:.4g} would keep them "
                   "apart.", who, 1.05 * enough), drifted);
}

void FixClusterTimestep::stop_energy(double error_now)
{
  const std::string what = kinetic
      ? "the kinetic energy rises (which gravity, gas and springs set free do as well: 'test balance' tells them apart)"
      : "contacts create energy";
  stop(fmt::format("{}: {:.3g} of it in one step, above {:.3g}, at the smallest step {:.4g} after {} rejections in a row. "
                   "Use a larger energy tolerance, a smaller floor or more retries.", what, error_now, tolerance,
                   update->dt, step.rejections_in_a_row()), false);
}

/* ---------------------------------------------------------------------- */

static constexpr int NSAVED = 4 + 4;

void FixClusterTimestep::write_restart(FILE *fp)
{
  if (comm->me) return;
  const double list[NSAVED] = {step.now(), worst_overlap, last_error, worst_error,
                               (double) count[0], (double) count[1], (double) count[2],
                               (double) count[3]};
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
    case 0: return update->dt;
    case 1: case 2: case 3: return static_cast<double>(count[n - 1]);
    case 4: return std::max(0.0, pairs.survey(overlap_limit, 0.0).deepest);
    case 5: return std::max(0.0, worst_overlap);
    case 6: return last_error;
    case 7: return worst_error;
    default: return static_cast<double>(count[LET_PASS]);
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
