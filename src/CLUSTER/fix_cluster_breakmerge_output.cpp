/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What fix cluster/breakmerge tells: its vector, its restart data, the grid's messages.

#include "fix_cluster_breakmerge.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;

// Of the restart data: the layout, and above the number of totals the test by which clusters were looked at. Version 0.1 wrote no mark.
static constexpr int64_t LAYOUT = int64_t(3) << 32;
static constexpr int64_t TEST = int64_t(1) << 16;

/* ----------------------------------------------------------------------
   clusters, particles, breakups, merges, fragments born, births deferred or shifted,
   energy lost in merges, energy put in by births, min, mean, max d; the other totals
------------------------------------------------------------------------- */

double FixClusterBreakMerge::compute_vector(int n)
{
  if (output_step == update->ntimestep) return output[n];
  output_step = update->ntimestep;
  double sum[3 + Census::NTOTALS] = {0.0}, all[3 + Census::NTOTALS];
  double most[2] = {-INFINITY, 0.0}, most_all[2];    // -min d, max d
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double d = 2.0 * atom->radius[i];
    sum[0] += 1.0;
    sum[1] += arrivals.particle_count(i);
    sum[2] += d;
    most[0] = MAX(most[0], -d);
    most[1] = MAX(most[1], d);
  }
  std::copy(census.totals().begin(), census.totals().end(), sum + 3);
  MPI_Allreduce(sum, all, 3 + Census::NTOTALS, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(most, most_all, 2, MPI_DOUBLE, MPI_MAX, world);
  output[0] = all[0];
  output[1] = all[1];
  std::copy(all + 3, all + 3 + Census::TESTS, output + 2);
  output[8] = all[0] > 0.0 ? -most_all[0] : 0.0;
  output[9] = all[0] > 0.0 ? all[2] / all[0] : 0.0;
  output[10] = most_all[1];
  std::copy(all + 3 + Census::TESTS, all + 3 + Census::NTOTALS, output + 11);
  return output[n];
}

/* ---------------------------------------------------------------------- */

double FixClusterBreakMerge::memory_usage()
{
  return table.bytes() + (check.cells() ? check.cells()->memory_usage() : 0.0);
}

/* ----------------------------------------------------------------------
   restart: totals and the highest ID ever used; particle counts follow from the masses. The number of totals goes ahead,
   in bits that no layout before version 0.1 has there.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::write_restart(FILE *fp)
{
  double state[Census::NTOTALS + 2];
  state[0] = ubuf(LAYOUT + settings.event.test * TEST + Census::NTOTALS).d;
  MPI_Reduce(census.totals().data(), state + 1, Census::NTOTALS, MPI_DOUBLE, MPI_SUM, 0, world);
  state[Census::NTOTALS + 1] = ubuf(tags.highest_used()).d;
  if (comm->me) return;
  const int size = sizeof(state);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(state, sizeof(state), 1, fp);
}

void FixClusterBreakMerge::restart(char *buf)
{
  const auto *state = (const double *) buf;
  const int64_t marked = ubuf(state[0]).i;
  resumed_from_0_1 = marked == Census::TOTALS_OF_0_1;
  const int64_t n = resumed_from_0_1 ? marked : (marked - LAYOUT) % TEST;
  const bool known = resumed_from_0_1 || (marked >= LAYOUT && marked - LAYOUT < 3 * TEST && n == Census::NTOTALS);
  if (!known)
    error->all(FLERR, "Fix {} {}: the restart file was written by another version of this fix", style, id);
  resumed_from_other_test = !resumed_from_0_1 && (marked - LAYOUT) / TEST != settings.event.test;
  Census::Totals totals = {};
  std::copy(state + 1, state + 1 + n, totals.begin());
  if (comm->me == 0) census.resume(totals);
  tags.raise((tagint) ubuf(state[n + 1]).i);
}

/* ----------------------------------------------------------------------
   Version 0.1 wrote the IDs of partners without their number. What a file of another test remembers of contacts is of no use:
   the ID of the atom alone is taken, which stands first.
------------------------------------------------------------------------- */

bool FixClusterBreakMerge::unpack_earlier(int i, const double *from, int n)
{
  if (resumed_from_other_test) {
    memcpy(&(*columns.seen)[i], from, sizeof(tagint));
    return true;
  }
  if (!resumed_from_0_1) return false;
  if (!columns.partners) return true;    // the file's test was another one
  for (int k = 0; k < n; k++) (*columns.partners)[i].push_back((tagint) ubuf(from[k]).i);
  return true;
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::reset_grid()
{
  if (check.cells()) check.cells()->reset();
}

void FixClusterBreakMerge::pack_forward_grid(int, void *buf, int nlist, int *list)
{
  check.cells()->pack((double *) buf, nlist, list);
}

void FixClusterBreakMerge::unpack_forward_grid(int, void *buf, int nlist, int *list)
{
  check.cells()->unpack((double *) buf, nlist, list, false);
}

void FixClusterBreakMerge::pack_reverse_grid(int, void *buf, int nlist, int *list)
{
  check.cells()->pack((double *) buf, nlist, list);
}

void FixClusterBreakMerge::unpack_reverse_grid(int, void *buf, int nlist, int *list)
{
  check.cells()->unpack((double *) buf, nlist, list, true);
}
