/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "step_state.h"

#include "atom.h"
#include "fix.h"
#include "modify.h"

#include <cstring>
#include <utility>

using namespace LAMMPS_NS;

static void copy(std::vector<double> &kept, double **from, int n)
{
  if (kept.size() < 3 * static_cast<std::size_t>(n)) kept.resize(3 * static_cast<std::size_t>(n));
  if (n) memcpy(kept.data(), from[0], 3 * sizeof(double) * n);
}

static void copy_back(double **to, const std::vector<double> &kept, int n)
{
  if (n) memcpy(to[0], kept.data(), 3 * sizeof(double) * n);
}

/* ---------------------------------------------------------------------- */

void StepState::keep(bool forces)
{
  clusters = atom->nlocal;
  with_forces = forces;
  copy(x, atom->x, clusters);
  copy(v, atom->v, clusters);
  if (atom->omega_flag) copy(omega, atom->omega, clusters);
  if (!forces) return;
  copy(f, atom->f, clusters);
  if (atom->torque_flag) copy(torque, atom->torque, clusters);
  keep_walls();
}

/* ----------------------------------------------------------------------
   a wall packs the history of a cluster as for one that leaves this rank
------------------------------------------------------------------------- */

void StepState::keep_walls()
{
  walls.clear();
  for (const auto &fix : modify->get_fix_by_style("^wall/gran")) {
    const int most = fix->maxsize_restart() + (fix->peratom_flag ? fix->size_peratom_cols : 0);
    if (most == 0) continue;    // it keeps nothing
    Wall wall{fix, std::vector<double>(static_cast<std::size_t>(clusters) * most)};
    std::size_t n = 0;
    for (int i = 0; i < clusters; i++) n += fix->pack_exchange(i, wall.history.data() + n);
    wall.history.resize(n);
    walls.push_back(std::move(wall));
  }
}

/* ---------------------------------------------------------------------- */

void StepState::put_back_motion()
{
  copy_back(atom->x, x, clusters);
  copy_back(atom->v, v, clusters);
  if (atom->omega_flag) copy_back(atom->omega, omega, clusters);
}

void StepState::put_back()
{
  put_back_motion();
  copy_back(atom->f, f, clusters);
  if (atom->torque_flag) copy_back(atom->torque, torque, clusters);
  for (Wall &wall : walls) {
    std::size_t n = 0;
    for (int i = 0; i < clusters; i++) n += wall.fix->unpack_exchange(i, wall.history.data() + n);
  }
}

/* ---------------------------------------------------------------------- */

double StepState::bytes() const
{
  double numbers = 0.0;
  for (const auto *kept : {&x, &v, &f, &omega, &torque}) numbers += static_cast<double>(kept->capacity());
  for (const Wall &wall : walls) numbers += static_cast<double>(wall.history.capacity());
  return numbers * sizeof(double);
}
