/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The state at the start of a step, how it is put back, and what contacts did to it.

#include "fix_cluster_timestep.h"

#include "pair_gran_cluster.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

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
   clusters that contacts push: pair forces are in, others are not yet
------------------------------------------------------------------------- */

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

/* ---------------------------------------------------------------------- */

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
  look_due = true;
  const bigint last = update->ntimestep - 1;
  update->atime += (last - update->atimestep) * update->dt;
  update->atimestep = update->ntimestep;
}
