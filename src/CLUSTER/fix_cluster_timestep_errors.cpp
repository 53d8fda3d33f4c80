/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The ends of a run: what is said, and the last good state written first.

#include "fix_cluster_timestep.h"

#include "pair_gran_cluster.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include "write_restart.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ----------------------------------------------------------------------
   Of pair gran/cluster the largest overlap of an approach is known in closed form; of another pair style a pair that is
   deep in contact and comes nearer after two halvings will not be stopped by a third.
------------------------------------------------------------------------- */

bool FixClusterTimestep::too_soft(const Meeting &m) const
{
  const double most = settings.overlap_limit * m.approach.smaller;
  if (!pair) return deep_and_closing(m.approach.overlap, m.approach.closing, most);
  return pair->contact_law().peak_overlap(m.mass, std::max(0.0, m.approach.overlap), m.approach.closing) >= most;
}

/* ----------------------------------------------------------------------
   nothing is lost: the last good state goes to a restart file before the error
------------------------------------------------------------------------- */

void FixClusterTimestep::stop(const std::string &message, bool drifted)
{
  if (drifted) state.put_back_motion();
  const bigint good = update->ntimestep - 1;
  clock.stand_at(good);
  const bigint mine = atom->nlocal;
  bigint all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all != atom->natoms)
    error->all(FLERR, "Fix {} {}: {} The state is not written: {} of {} clusters were lost before.", style, id,
               message, atom->natoms - all, atom->natoms);
  const std::string file = fmt::format("{}.{}.restart", id, good);
  domain->pbc();
  WriteRestart writer(lmp);
  writer.multiproc_options(0, 0, nullptr);
  writer.write(file);
  error->all(FLERR, "Fix {} {}: {} The state of step {} is in {}.", style, id, message, good, file);
}

void FixClusterTimestep::stop_too_soft(const Meeting &m, bool drifted)
{
  if (m.approach.smaller == 0.0)
    stop(fmt::format("clusters approach each other at up to {:.4g} and could pass unseen at the smallest step "
                     "{:.4g}: allow "
                     "a smaller floor or more retries, or 'predict yes'.",
                     motion.bounds().closing(), update->dt),
         drifted);
  const double most = settings.overlap_limit * m.approach.smaller;
  const std::string who =
      fmt::format("clusters {:.0f} and {:.0f} overlap by {:.4g}, {:.3g} of the smaller diameter {:.4g}, "
                  "and approach at {:.4g}",
                  m.tags[0], m.tags[1], m.approach.overlap, m.approach.overlap / m.approach.smaller,
                  m.approach.smaller, m.approach.closing);
  if (!too_soft(m))
    stop(fmt::format("{}, beyond the limit {} at the smallest step {:.4g}: allow a smaller floor or more retries.",
                     who, settings.overlap_limit, update->dt),
         drifted);
  double enough = stopping_stiffness(m.mass, m.approach.closing, most);
  if (pair) {
    const auto &law = pair->contact_law();
    enough =
        law.stiffness_for(law.peak_overlap(m.mass, std::max(0.0, m.approach.overlap), m.approach.closing), most);
  }
  stop(fmt::format(
           "the contact spring is too soft, no smaller step helps: {}; k_n of at least {:.4g} would keep them "
           "apart.",
           who, 1.05 * enough),
       drifted);
}

void FixClusterTimestep::stop_energy(double error_now)
{
  const std::string what = settings.kinetic
      ? "the kinetic energy rises (which gravity, gas and springs set free do as "
        "well: 'test balance' tells them apart)"
      : "contacts create energy";
  stop(fmt::format(
           "{}: {:.3g} of it in one step, above {:.3g}, at the smallest step {:.4g} after {} rejections in a row. "
           "Use a larger energy tolerance, a smaller floor or more retries.",
           what, error_now, settings.tolerance, update->dt, step.rejections_in_a_row()),
       false);
}
