/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "energy_balance.h"

#include "pair_gran_cluster.h"
#include "step_motion.h"

#include "atom.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

EnergyBalance::EnergyBalance(LAMMPS *lmp, double tolerance, bool kinetic_alone) :
    Pointers(lmp), limit(tolerance), kinetic(kinetic_alone), pair(nullptr), elastic_before(0.0), kinetic_mine(0.0),
    energy_all(0.0), most_energy(0.0), restless_all{INFINITY, 0.0}, recent_error(0.0), last_error(0.0), worst(0.0)
{
}

/* ---------------------------------------------------------------------- */

void EnergyBalance::start_run(const PairGranCluster *style)
{
  pair = style;
  recent_error = 0.0;
  restless_all = {INFINITY, 0.0};
  most_energy = 0.0;
  note_contacts();
  step_ends();
}

/* ---------------------------------------------------------------------- */

void EnergyBalance::note_contacts()
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

void EnergyBalance::note_start()
{
  for (Pushed &p : pushed_before) {
    p.v = to_vec3(atom->v[p.i]);
    if (atom->torque_flag) p.omega = to_vec3(atom->omega[p.i]);
  }
}

void EnergyBalance::step_ends()
{
  pushed_before.swap(pushed);
  elastic_before = pair->elastic_energy();
}

/* ---------------------------------------------------------------------- */

bool EnergyBalance::may_fail(double dt, double stiffness, const StepMotion &motion) const
{
  if (kinetic || recent_error > 0.01) return true;
  return !(possible_creation(dt, restless_all, stiffness, motion.lightest(), motion.heaviest(),
                             motion.bounds().closing()) < limit * energy_all);
}

/* ---------------------------------------------------------------------- */

EnergyBalance::Verdict EnergyBalance::judge()
{
  const double created = kinetic ? kinetic_energy() - kinetic_mine
                                 : contact_work() + pair->elastic_energy() - elastic_before;
  const double mine[4] = {created, kinetic ? kinetic_mine : kinetic_mine + elastic_before,
                          pair->restlessness().swing, pair->restlessness().creep};
  double all[4];
  MPI_Allreduce(mine, all, 4, MPI_DOUBLE, MPI_SUM, world);
  most_energy = std::max(most_energy, all[1]);
  const double relative = relative_creation(all[0] - ROUNDED_ENERGY * most_energy, all[1]);
  return {relative, !(relative <= limit), all[1], {all[2], all[3]}};
}

void EnergyBalance::accept(const Verdict &verdict)
{
  energy_all = verdict.all_energy;
  restless_all = verdict.restless;
  last_error = verdict.created;
  worst = std::max(worst, last_error);
  recent_error = ClusterDEM::recent_error(recent_error, last_error / limit);
  step_ends();
}

void EnergyBalance::go_on_untested()
{
  last_error = 0.0;
  const auto &restless = pair->restlessness();
  double mine[2] = {restless.swing, restless.creep}, all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
  restless_all = {all[0], all[1]};
  step_ends();
}

/* ---------------------------------------------------------------------- */

double EnergyBalance::kinetic_energy() const
{
  const int nlocal = atom->nlocal;
  const double *v = nlocal ? atom->v[0] : nullptr, *rmass = atom->rmass;
  double sum = 0.0;
  for (int i = 0; i < nlocal; i++) sum += twice_kinetic_energy(rmass[i], v + 3 * static_cast<std::size_t>(i));
  return 0.5 * force->mvv2e * sum;
}

/* ----------------------------------------------------------------------
   A cluster that was not pushed before has its omega of the start, and half a step of the other forces in its v.
------------------------------------------------------------------------- */

double EnergyBalance::contact_work() const
{
  double **v = atom->v, **f = atom->f, **omega = atom->omega;
  const bool rotating = atom->torque_flag;
  double sum = 0.0;
  auto add = [&](const Pushed &p, const Vec3 &v_start, const Vec3 &omega_start) {
    sum += quarter_work(p.force, v_start, to_vec3(v[p.i]));
    if (rotating) sum += quarter_work(p.torque, omega_start, to_vec3(omega[p.i]));
  };
  for (const Pushed &p : pushed_before) add(p, p.v, p.omega);
  auto before = pushed_before.begin();
  for (const Pushed &p : pushed) {
    while (before != pushed_before.end() && before->i < p.i) ++before;
    if (before != pushed_before.end() && before->i == p.i) add(p, before->v, before->omega);
    else
      add(p, velocity_at_start(p.v, to_vec3(f[p.i]) - p.force, atom->rmass[p.i], update->dt, force->ftm2v),
          p.omega);
  }
  return ClusterDEM::contact_work(update->dt, sum);
}
