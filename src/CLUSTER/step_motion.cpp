/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "step_motion.h"

#include "pair_gran_cluster.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

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

/* ---------------------------------------------------------------------- */

void StepMotion::weigh()
{
  double mine[3] = {-INFINITY, 0.0, -INFINITY}, all[3];
  for (int i = 0; i < atom->nlocal; i++) {
    mine[0] = std::max(mine[0], -atom->rmass[i]);
    mine[1] = std::max(mine[1], atom->rmass[i]);
    mine[2] = std::max(mine[2], -atom->radius[i]);
  }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_MAX, world);
  least_mass = -all[0];
  most_mass = all[1];
  least_diameter = -2.0 * all[2];
}

/* ---------------------------------------------------------------------- */

void StepMotion::look()
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
  motion.looked(norm(width), norm(most), force->ftm2v * std::sqrt(all[6]));
  looks_ago = 0;
  due = false;
}

/* ---------------------------------------------------------------------- */

void StepMotion::reckon()
{
  motion.pushed(style ? motion.with_contacts(strongest_contact()) : largest_force() / least_mass, update->dt);
}

double StepMotion::strongest_contact() const
{
  double all;
  const double mine = force->ftm2v * style->restlessness().strongest;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  return all;
}

// of another pair style contact forces are not told apart
double StepMotion::largest_force() const
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

/* ---------------------------------------------------------------------- */

void StepMotion::stop_not_finite() const
{
  error->all(FLERR, "{}: a velocity or force is not finite at step {}", me, update->ntimestep - 1);
}
