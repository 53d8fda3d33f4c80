/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the fix tells, and what it keeps in restart files.

#include "fix_cluster_timestep.h"

#include "comm.h"
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
   last step, worst accepted, steps let pass
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
    default:
      return static_cast<double>(count[LET_PASS]);
  }
}

/* ---------------------------------------------------------------------- */

double FixClusterTimestep::memory_usage()
{
  return state.bytes() + energy.bytes();
}
