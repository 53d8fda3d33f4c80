/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the fix tells, and what it keeps in restart files.

#include "fix_cluster_timestep.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

static constexpr int NSAVED = 4 + 4;

void FixClusterTimestep::write_restart(FILE *fp)
{
  if (comm->me) return;
  const double list[NSAVED] = {step.now(),        worst_depth,       energy.error_of_last(), energy.worst_error(),
                               (double) count[0], (double) count[1], (double) count[2],      (double) count[3]};
  const int size = sizeof(list);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list, sizeof(double), NSAVED, fp);
}

void FixClusterTimestep::restart(char *buf)
{
  double list[NSAVED];
  memcpy(list, buf, sizeof(list));
  step.start(list[0]);
  worst_depth = list[1];
  energy.restore(list[2], list[3]);
  for (int k = 0; k < NCOUNTS; k++) count[k] = static_cast<bigint>(list[4 + k]);
}

/* ---------------------------------------------------------------------- */

double FixClusterTimestep::compute_scalar()
{
  return update->dt;
}

/* ----------------------------------------------------------------------
   step, rejections by overlap, by energy, steps untested, overlap now, worst overlap accepted, energy error of the
   last step, worst accepted, steps let pass, elastic energy of all contacts now
------------------------------------------------------------------------- */

double FixClusterTimestep::compute_vector(int n)
{
  switch (n) {
    case 0:
      return update->dt;
    case 1:
    case 2:
    case 3:
      return static_cast<double>(count[n - 1]);
    case 4:
      return std::max(0.0, survey.look(settings.overlap_limit, 0.0).deepest);
    case 5:
      return std::max(0.0, worst_depth);
    case 6:
      return energy.error_of_last();
    case 7:
      return energy.worst_error();
    case 8:
      return static_cast<double>(count[LET_PASS]);
    default:
      return stored_energy();
  }
}

/* ----------------------------------------------------------------------
   a contact of clusters of two ranks stands on both with newton off
------------------------------------------------------------------------- */

double FixClusterTimestep::stored_energy()
{
  contacts.find_contacts();
  double mine = 0.0, all;
  for (const auto &contact : contacts.contacts()) {
    const bool on_both = !force->newton_pair && contact.j >= atom->nlocal;
    mine += (on_both ? 0.5 : 1.0) * contacts.energy_now(contact);
  }
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ---------------------------------------------------------------------- */

double FixClusterTimestep::memory_usage()
{
  return state.bytes() + energy.bytes();
}
