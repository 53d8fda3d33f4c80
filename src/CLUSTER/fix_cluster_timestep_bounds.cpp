/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What bounds the step: masses, speeds, forces, and how near clusters are.

#include "fix_cluster_timestep.h"

#include "fix_cluster_breakmerge.h"
#include "pair_gran_cluster.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr double PREDICTED_SHARE = 0.9;    // of the time to the overlap limit
static constexpr int LOOK_EVERY = 8;              // steps between looks at all velocities
static constexpr double OTHER_FORCES = 2.0;       // how much they may grow between looks
static constexpr double MARGIN = 1.01;            // and what they may do where there were none

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
   What bounds the step, on all ranks. All velocities and forces are looked at now and then; in between the range of
   velocities grows by what contacts push and by other forces, which are taken to double at most.
------------------------------------------------------------------------- */

void FixClusterTimestep::observe()
{
  if (look_due || ++looks_ago >= LOOK_EVERY || kinetic) {
    look();
    return;
  }
  const double before = motion.acceleration;
  motion.acceleration = pair ? OTHER_FORCES * acceleration_at_look + MOST_CONTACTS * strongest_contact()
                             : largest_force() / motion.lightest;
  gain += 0.5 * (before + motion.acceleration) * update->dt;    // of the step before this one
  motion.closing = MARGIN * range + 2.0 * gain;
  motion.speed = MARGIN * fastest + gain;
}

double FixClusterTimestep::strongest_contact() const
{
  double all;
  const double mine = force->ftm2v * pair->restlessness().strongest;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  return all;
}

// of another pair style contact forces are not told apart
double FixClusterTimestep::largest_force()
{
  double lowest[3], highest[3], mine[4], all[4];
  std::fill(lowest, lowest + 3, INFINITY);
  std::fill(highest, highest + 3, -INFINITY);
  mine[3] = extremes(atom->f, atom->nlocal, lowest, highest) ? 0.0 : 1.0;
  for (int k = 0; k < 3; k++) mine[k] = std::max({0.0, -lowest[k], highest[k]});
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_MAX, world);
  if (all[3] > 0.0) stop_not_finite();
  return force->ftm2v * norm({all[0], all[1], all[2]});
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
  motion.acceleration = acceleration_at_look = force->ftm2v * std::sqrt(all[6]);
  gain = 0.0;
  looks_ago = 0;
  look_due = false;
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
  return !(possible_creation(update->dt, restless_all, stiffness, motion.lightest, motion.heaviest,
                             motion.closing) < tolerance * energy_all);
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
