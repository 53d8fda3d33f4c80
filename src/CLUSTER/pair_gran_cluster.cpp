/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "pair_gran_cluster.h"

#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr int HISTORY = 3;    // tangential displacement

// Two clusters in contact: the normal n points from j to i, forces act on i.
struct PairGranCluster::Touching {
  double r, overlap, m, eta, f_n;    // m: reduced mass
  Vec3 n, slip;                      // slip: tangential velocity of i relative to j where they touch
  Vec3 velocity;                     // of i's centre relative to j's
  Vec3 friction{0.0, 0.0, 0.0};

  Vec3 force() const { return f_n * n + friction; }
};

/* ---------------------------------------------------------------------- */

PairGranCluster::PairGranCluster(LAMMPS *lmp) :
    PairGranHookeHistory(lmp), cutoff_given(0.0), rotating(true), record_step(-1), recorded_step(-1), elastic(0.0),
    elastic_before(0.0), restless{}, undoable(false)
{
}

/* ----------------------------------------------------------------------
   pair_style gran/cluster k_n e mu keyword values ...
------------------------------------------------------------------------- */

void PairGranCluster::settings(int narg, char **arg)
{
  StyleArguments args(lmp, "pair_style gran/cluster", narg, arg);
  law = ContactLaw();
  cutoff_given = 0.0;
  law.k_n = args.positive("k_n", "force/length");
  law.e = args.within("e", 0.0, 1.0);
  law.mu = args.within("mu", 0.0, 1.0e4);
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "tangential")
      law.tangential = static_cast<Tangential>(args.choice(keyword, {"md", "linear", "none"}));
    else if (keyword == "delta_max") {
      if (args.choice(keyword, {"poisson", "kt"}) == 0) {
        const char *rule = "a number > -1 and <= 0.5";
        law.nu = args.number("delta_max poisson NU", rule);
        if (!(law.nu > -1.0 && law.nu <= 0.5)) args.refuse("delta_max poisson NU", rule);
        law.k_t = 0.0;
      } else law.k_t = args.positive("delta_max kt K_T", "force/length");
    } else if (keyword == "direction")
      law.direction = static_cast<FrictionDirection>(args.choice(keyword, {"displacement", "velocity"}));
    else if (keyword == "cutoff") cutoff_given = args.positive("cutoff D_MAX", "length");
    else args.unknown_keyword();
  }
  if (law.mu == 0.0) law.tangential = Tangential::NONE;    // nothing to remember, nothing to compute
  law.derive();
  history = law.tangential != Tangential::NONE;
}

/* ---------------------------------------------------------------------- */

void PairGranCluster::init_style()
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR,
               "Pair style gran/cluster requires atom style sphere or cluster: clusters have a diameter and a "
               "mass");
  if (comm->ghost_velocity == 0)
    error->all(FLERR, "Pair style gran/cluster needs the velocities of ghost clusters: use comm_modify vel yes");

  // The base class asks for omega, which only its own compute() reads.
  rotating = atom->omega_flag && atom->torque_flag;
  const int omega_flag = atom->omega_flag;
  atom->omega_flag = 1;
  PairGranHookeHistory::init_style();
  atom->omega_flag = omega_flag;
  if (fix_rigid)
    error->all(FLERR, "Pair style gran/cluster does not support fix {} {}: clusters are spheres of their own mass",
               ((Fix *) fix_rigid)->style, ((Fix *) fix_rigid)->id);
  changes.clear();
  recorded_step = -1;
}

/* ----------------------------------------------------------------------
   the largest radii there are, or the contact distance that merging may lead to
------------------------------------------------------------------------- */

double PairGranCluster::init_one(int i, int j)
{
  return std::max(PairGranHookeHistory::init_one(i, j), cutoff_given);
}

/* ---------------------------------------------------------------------- */

double PairGranCluster::reduced_mass(int i, int j) const
{
  const double mi = atom->rmass[i], mj = atom->rmass[j];
  if (atom->mask[i] & freeze_group_bit) return mj;
  if (atom->mask[j] & freeze_group_bit) return mi;
  return mi * mj / (mi + mj);
}

/* ----------------------------------------------------------------------
   normal force and slip; a contact reaches half of the overlap below each surface
------------------------------------------------------------------------- */

template <bool ROTATE> PairGranCluster::Touching PairGranCluster::look_at(int i, int j, double rsq) const
{
  Touching c;
  c.r = std::sqrt(rsq);
  c.overlap = atom->radius[i] + atom->radius[j] - c.r;
  c.n = (1.0 / c.r) * (to_vec3(atom->x[i]) - to_vec3(atom->x[j]));
  c.velocity = to_vec3(atom->v[i]) - to_vec3(atom->v[j]);
  const double v_n = dot(c.velocity, c.n);
  c.m = reduced_mass(i, j);
  c.eta = law.damping(c.m);
  c.f_n = law.normal(c.overlap, c.eta, v_n);
  c.slip = c.velocity - v_n * c.n;
  if (ROTATE) {
    const Vec3 spin = (atom->radius[i] - 0.5 * c.overlap) * to_vec3(atom->omega[i]) +
        (atom->radius[j] - 0.5 * c.overlap) * to_vec3(atom->omega[j]);
    c.slip = c.slip - cross(spin, c.n);
  }
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
  const double arm_i = atom->radius[i] - 0.5 * c.overlap, arm_j = atom->radius[j] - 0.5 * c.overlap;
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
    const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
    const double rsq = dx * dx + dy * dy + dz * dz;
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

    Touching c = look_at<ROTATE>(i, j, rsq);
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
    restless.strongest = MAX(restless.strongest, std::sqrt(force_sq) / MIN(atom->rmass[i], atom->rmass[j]));
    restless.swing += share * law.k_n * (0.5 * speed_sq + energy / c.m);
    if (FRICTION)
      restless.creep += share * (energy - law.normal_energy(c.overlap)) * std::sqrt(speed_sq) / c.overlap;
    if (recording) recorded.push_back({i, j, dot(force, c.velocity), std::sqrt(force_sq)});
    add_force<ROTATE>(i, j, c);
    if (evflag)
      ev_tally_xyz(i, j, nlocal, this->force->newton_pair, energy, 0.0, force[0], force[1], force[2], dx, dy, dz);
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
  Touching c = rotating && friction ? look_at<true>(i, j, rsq) : look_at<false>(i, j, rsq);
  double energy = law.normal_energy(c.overlap);
  if (friction) {
    const double *stored = displacement_of(i, j);
    Vec3 displacement = stored ? to_vec3(stored) : Vec3{0.0, 0.0, 0.0};
    c.friction = law.friction(c.overlap, c.f_n, c.eta, c.slip, displacement);
    energy += law.tangential_energy(c.overlap, c.f_n, displacement);
  }
  fforce = c.f_n / c.r;
  const Vec3 along = dot(c.velocity, c.n) * c.n;
  for (int k = 0; k < 3; k++) {
    svector[k] = c.friction[k];
    svector[4 + k] = along[k];
    svector[7 + k] = c.velocity[k] - along[k];
  }
  svector[3] = norm(c.friction);
  return energy;
}

/* ---------------------------------------------------------------------- */

static constexpr int NSETTINGS = 8;

void PairGranCluster::write_restart_settings(FILE *fp)
{
  const double settings[NSETTINGS] = {law.k_n,
                                      law.e,
                                      law.mu,
                                      law.nu,
                                      law.k_t,
                                      cutoff_given,
                                      static_cast<double>(law.tangential),
                                      static_cast<double>(law.direction)};
  fwrite(settings, sizeof(double), NSETTINGS, fp);
}

void PairGranCluster::read_restart_settings(FILE *fp)
{
  double settings[NSETTINGS];
  if (comm->me == 0) utils::sfread(FLERR, settings, sizeof(double), NSETTINGS, fp, nullptr, error);
  MPI_Bcast(settings, NSETTINGS, MPI_DOUBLE, 0, world);
  law.k_n = settings[0];
  law.e = settings[1];
  law.mu = settings[2];
  law.nu = settings[3];
  law.k_t = settings[4];
  cutoff_given = settings[5];
  law.tangential = static_cast<Tangential>(static_cast<int>(settings[6]));
  law.direction = static_cast<FrictionDirection>(static_cast<int>(settings[7]));
  law.derive();
  history = law.tangential != Tangential::NONE;
}

/* ---------------------------------------------------------------------- */

double PairGranCluster::memory_usage()
{
  return PairGranHookeHistory::memory_usage() + (double) changes.capacity() * sizeof(Change) +
      (double) recorded.capacity() * sizeof(Contact) + (double) near.capacity() * sizeof(NearPair);
}
