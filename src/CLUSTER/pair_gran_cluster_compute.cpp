/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The forces of pair gran/cluster.

#include "pair_gran_cluster.h"

#include "model/touch.h"

#include "atom.h"
#include "error.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr int HISTORY = 3;    // tangential displacement

// Two clusters in contact, and the force on i.
struct PairGranCluster::Touching : Touch {
  double m, eta, f_n;    // m: reduced mass
  Vec3 friction{0.0, 0.0, 0.0};

  explicit Touching(const Touch &touch) : Touch(touch), m(0.0), eta(0.0), f_n(0.0) {}
  Vec3 force() const { return f_n * n + friction; }
};

/* ----------------------------------------------------------------------
   normal force and slip
------------------------------------------------------------------------- */

template <bool ROTATE> PairGranCluster::Touching PairGranCluster::look_at(int i, int j, const Vec3 &d) const
{
  const double *radius = atom->radius;
  Touch touch = touch_of(radius[i], radius[j], d, to_vec3(atom->v[i]) - to_vec3(atom->v[j]));
  if (ROTATE) touch = turning(touch, radius[i], to_vec3(atom->omega[i]), radius[j], to_vec3(atom->omega[j]));
  Touching c(touch);
  c.m = reduced_mass(i, j);
  c.eta = law.damping(c.m);
  c.f_n = law.normal(c.overlap, c.eta, c.v_n);
  return c;
}

/* ---------------------------------------------------------------------- */

template <bool ROTATE> void PairGranCluster::add_force(int i, int j, const Touching &c)
{
  const Vec3 force = c.force();
  for (int k = 0; k < 3; k++) atom->f[i][k] += force[k];
  const bool both = this->force->newton_pair || j < atom->nlocal;
  if (both)
    for (int k = 0; k < 3; k++) atom->f[j][k] -= force[k];
  if (!ROTATE) return;
  const Vec3 twist = cross(c.n, c.friction);
  const double arm_i = contact_arm(atom->radius[i], c.overlap), arm_j = contact_arm(atom->radius[j], c.overlap);
  for (int k = 0; k < 3; k++) atom->torque[i][k] -= arm_i * twist[k];
  if (both)
    for (int k = 0; k < 3; k++) atom->torque[j][k] -= arm_j * twist[k];
}

/* ---------------------------------------------------------------------- */

void PairGranCluster::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  changes.clear();
  recorded.clear();
  recorded_step = update->ntimestep == record_step ? record_step : -1;
  elastic_before = elastic;
  elastic = 0.0;
  restless = {};

  const bool friction = law.tangential != Tangential::NONE;
  if (rotating && friction) compute_contacts<true, true>();
  else if (friction) compute_contacts<false, true>();
  else compute_contacts<false, false>();    // without friction nothing makes a cluster turn
}

/* ---------------------------------------------------------------------- */

template <bool ROTATE, bool FRICTION> void PairGranCluster::compute_contacts()
{
  double **x = atom->x;
  const double *radius = atom->radius;
  const int nlocal = atom->nlocal;
  const bool moving = !update->setupflag;    // set-up evaluates the same instant again
  const bool recording = recorded_step >= 0;
  if (neighbor->ago == 0 || update->setupflag) flatten_list();

  for (const auto &[i, j, slot] : near) {
    const Vec3 d = to_vec3(x[i]) - to_vec3(x[j]);
    const double rsq = dot(d, d);
    const double reach = radius[i] + radius[j];
    int *touch = FRICTION ? fix_history->firstflag[i] + slot : nullptr;
    double *s = FRICTION ? fix_history->firstvalue[i] + HISTORY * slot : nullptr;
    if (rsq >= reach * reach) {
      if (FRICTION && *touch) {
        if (undoable) changes.push_back({touch, s, *touch, to_vec3(s)});
        *touch = 0;
        s[0] = s[1] = s[2] = 0.0;
      }
      continue;
    }

    Touching c = look_at<ROTATE>(i, j, d);
    double energy = law.normal_energy(c.overlap);
    if (FRICTION) {
      if (undoable) changes.push_back({touch, s, *touch, to_vec3(s)});
      *touch = 1;
      Vec3 displacement = to_vec3(s);
      if (moving) displacement = turn_into_plane(displacement, c.n) + dt * c.slip;
      c.friction = law.friction(c.overlap, c.f_n, c.eta, c.slip, displacement);
      if (moving)
        for (int k = 0; k < 3; k++) s[k] = displacement[k];
      energy += law.tangential_energy(c.overlap, c.f_n, displacement);
    }
    const Vec3 force = c.force();
    const double force_sq = dot(force, force);
    if (!std::isfinite(force_sq))
      error->one(FLERR,
                 "Pair style gran/cluster: the contact force of clusters {} and {} is not finite at step {}: "
                 "their centres are {} apart and their relative speed is {}",
                 atom->tag[i], atom->tag[j], update->ntimestep, c.r, norm(c.velocity));

    const bool both = this->force->newton_pair || j < nlocal;
    const double share = both ? 1.0 : 0.5;
    elastic += share * energy;
    const double speed_sq = dot(c.velocity, c.velocity);
    restless.add_force(std::sqrt(force_sq), atom->rmass[i], atom->rmass[j]);
    restless.add_swing(share, law.k_n, speed_sq, energy, c.m);
    if (FRICTION) restless.add_creep(share, energy - law.normal_energy(c.overlap), speed_sq, c.overlap);
    if (recording) recorded.push_back({i, j, dot(force, c.velocity), std::sqrt(force_sq)});
    add_force<ROTATE>(i, j, c);
    if (evflag)
      ev_tally_xyz(i, j, nlocal, this->force->newton_pair, energy, 0.0, force[0], force[1], force[2], d[0], d[1],
                   d[2]);
  }
}

/* ----------------------------------------------------------------------
   Few clusters have a neighbor at all: the pairs in one row spare a look at each of the others, every step.
------------------------------------------------------------------------- */

void PairGranCluster::flatten_list()
{
  near.clear();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int slot = 0; slot < list->numneigh[i]; slot++)
      near.push_back({i, list->firstneigh[i][slot] & NEIGHMASK, slot});
  }
}

/* ----------------------------------------------------------------------
   put the contact history back to what it was before the last compute()
------------------------------------------------------------------------- */

void PairGranCluster::undo()
{
  for (const Change &change : changes) {
    *change.touch = change.touch_was;
    for (int k = 0; k < 3; k++) change.displacement[k] = change.displacement_was[k];
  }
  changes.clear();
  elastic = elastic_before;
  recorded_step = -1;
}

/* ----------------------------------------------------------------------
   stored tangential displacement of i relative to j, looked up where the last search ended
------------------------------------------------------------------------- */

double *PairGranCluster::displacement_of(int i, int j)
{
  const int *jlist = list->firstneigh[i];
  const int jnum = list->numneigh[i];
  for (int k = 0; k < jnum; k++) {
    if (++neighprev >= jnum) neighprev = 0;
    if ((jlist[neighprev] & NEIGHMASK) == j) return fix_history->firstvalue[i] + HISTORY * neighprev;
  }
  return nullptr;
}

/* ----------------------------------------------------------------------
   returns the elastic energy, fforce = normal force over distance; svector: tangential force and its size,
   then the normal and the tangential velocity of i relative to j, as in the other gran styles
------------------------------------------------------------------------- */

double PairGranCluster::single(int i, int j, int, int, double rsq, double, double, double &fforce)
{
  const double reach = atom->radius[i] + atom->radius[j];
  fforce = 0.0;
  for (int m = 0; m < single_extra; m++) svector[m] = 0.0;
  if (rsq >= reach * reach) return 0.0;

  const bool friction = law.tangential != Tangential::NONE;
  const Vec3 d = to_vec3(atom->x[i]) - to_vec3(atom->x[j]);
  Touching c = rotating && friction ? look_at<true>(i, j, d) : look_at<false>(i, j, d);
  double energy = law.normal_energy(c.overlap);
  if (friction) {
    const double *stored = displacement_of(i, j);
    Vec3 displacement = stored ? to_vec3(stored) : Vec3{0.0, 0.0, 0.0};
    c.friction = law.friction(c.overlap, c.f_n, c.eta, c.slip, displacement);
    energy += law.tangential_energy(c.overlap, c.f_n, displacement);
  }
  fforce = c.f_n / c.r;
  const Vec3 along = c.v_n * c.n;
  for (int k = 0; k < 3; k++) {
    svector[k] = c.friction[k];
    svector[4 + k] = along[k];
    svector[7 + k] = c.velocity[k] - along[k];
  }
  svector[3] = norm(c.friction);
  return energy;
}
