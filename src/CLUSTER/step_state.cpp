/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "step_state.h"

#include "atom.h"

#include <cstring>

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
}

/* ---------------------------------------------------------------------- */

double StepState::bytes() const
{
  double numbers = 0.0;
  for (const auto *kept : {&x, &v, &f, &omega, &torque}) numbers += static_cast<double>(kept->capacity());
  return numbers * sizeof(double);
}
