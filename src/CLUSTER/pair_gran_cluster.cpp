/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "pair_gran_cluster.h"

#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

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
  return ClusterDEM::reduced_mass(mi, mj);
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
