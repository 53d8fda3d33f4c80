/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What clusters tell each other: between owned and ghost, on migration, in restart files.

#include "fix_cluster_breakmerge.h"

#include "cell_averages.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::exchange(int stage, int size)
{
  comm_stage = static_cast<decltype(comm_stage)>(stage);
  if (stage == CONTACTS || stage == SUITORS) comm->reverse_comm(this, size);
  else comm->forward_comm(this, size);
}

/* ---------------------------------------------------------------------- */

int FixClusterBreakMerge::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int i = list[k];
    if (comm_stage == SIZES) {
      buf[m++] = ubuf(count[i]).d;
      buf[m++] = ubuf(stable[i]).d;
    } else if (comm_stage == PARTNERS) buf[m++] = ubuf(suitor[i].tag).d;
    else if (comm_stage == CLAIMS) {
      for (int c = 0; c < 4; c++) buf[m++] = room[i][c];
      buf[m++] = ubuf(needs[i]).d;
    } else if (comm_stage == IDS) buf[m++] = ubuf(atom->tag[i]).d;
    else buf[m++] = ubuf(proceeds[i]).d;
  }
  return m;
}

void FixClusterBreakMerge::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; i++) {
    if (comm_stage == SIZES) {
      count[i] = (int) ubuf(buf[m++]).i;
      stable[i] = (int) ubuf(buf[m++]).i;
    } else if (comm_stage == PARTNERS) suitor[i].tag = (tagint) ubuf(buf[m++]).i;
    else if (comm_stage == CLAIMS) {
      for (int c = 0; c < 4; c++) room[i][c] = buf[m++];
      needs[i] = (int) ubuf(buf[m++]).i;
    } else if (comm_stage == IDS) atom->tag[i] = (tagint) ubuf(buf[m++]).i;
    else proceeds[i] = (int) ubuf(buf[m++]).i;
  }
}

/* ----------------------------------------------------------------------
   sums of contacts add up; of two suitors the better one stays
------------------------------------------------------------------------- */

int FixClusterBreakMerge::pack_reverse_comm_size(int n, int first)
{
  int m = 0;
  for (int i = first; i < first + n; i++) m += 1 + static_cast<int>(touching_tags[i].size());
  return m;
}

int FixClusterBreakMerge::pack_reverse_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; i++) {
    if (comm_stage == CONTACTS) {
      buf[m++] = power[i];
      buf[m++] = ubuf(ncontacts[i]).d;
    } else if (comm_stage == TAGS) {
      buf[m++] = ubuf((tagint) touching_tags[i].size()).d;
      for (tagint tag : touching_tags[i]) buf[m++] = ubuf(tag).d;
    } else {
      buf[m++] = suitor[i].slip;
      buf[m++] = suitor[i].stiffness;
      buf[m++] = ubuf(suitor[i].tag).d;
    }
  }
  return m;
}

void FixClusterBreakMerge::unpack_reverse_comm(int n, int *list, double *buf)
{
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int i = list[k];
    if (comm_stage == CONTACTS) {
      power[i] += buf[m++];
      ncontacts[i] += (int) ubuf(buf[m++]).i;
    } else if (comm_stage == TAGS) {
      const auto size = ubuf(buf[m++]).i;
      for (int64_t t = 0; t < size; t++) touching_tags[i].push_back((tagint) ubuf(buf[m++]).i);
    } else {
      const Suitor other{buf[m], buf[m + 1], (tagint) ubuf(buf[m + 2]).i};
      m += 3;
      if (other.tag && (suitor[i].tag == 0 || other.better_than(suitor[i]))) suitor[i] = other;
    }
  }
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::pack_forward_grid(int, void *buf, int nlist, int *list)
{
  averages->pack((double *) buf, nlist, list);
}

void FixClusterBreakMerge::unpack_forward_grid(int, void *buf, int nlist, int *list)
{
  averages->unpack((double *) buf, nlist, list, false);
}

void FixClusterBreakMerge::pack_reverse_grid(int, void *buf, int nlist, int *list)
{
  averages->pack((double *) buf, nlist, list);
}

void FixClusterBreakMerge::unpack_reverse_grid(int, void *buf, int nlist, int *list)
{
  averages->unpack((double *) buf, nlist, list, true);
}

/* ----------------------------------------------------------------------
   per cluster: particle count, outputs, and with test end the contacts of the last test
------------------------------------------------------------------------- */

void FixClusterBreakMerge::grow_arrays(int nmax)
{
  memory->grow(count, nmax, "cluster/breakmerge:count");
  memory->grow(array_atom, nmax, size_peratom_cols, "cluster/breakmerge:array_atom");
  if (test == CONTACT_ENDED) partners.resize(nmax);
}

void FixClusterBreakMerge::copy_arrays(int i, int j, int delflag)
{
  if (delflag) note_deleted(j);
  count[j] = count[i];
  memcpy(array_atom[j], array_atom[i], size_peratom_cols * sizeof(double));
  if (test == CONTACT_ENDED) partners[j] = partners[i];
}

void FixClusterBreakMerge::set_arrays(int i)
{
  count[i] = 0;
  memset(array_atom[i], 0, size_peratom_cols * sizeof(double));
  if (test == CONTACT_ENDED) partners[i].clear();
}

int FixClusterBreakMerge::pack_exchange(int i, double *buf)
{
  int m = 0;
  buf[m++] = ubuf(count[i]).d;
  for (int c = 0; c < size_peratom_cols; c++) buf[m++] = array_atom[i][c];
  if (test == CONTACT_ENDED) {
    buf[m++] = ubuf((tagint) partners[i].size()).d;
    for (tagint tag : partners[i]) buf[m++] = ubuf(tag).d;
  }
  return m;
}

int FixClusterBreakMerge::unpack_exchange(int i, double *buf)
{
  int m = 0;
  count[i] = (int) ubuf(buf[m++]).i;
  for (int c = 0; c < size_peratom_cols; c++) array_atom[i][c] = buf[m++];
  if (test == CONTACT_ENDED) {
    partners[i].resize(ubuf(buf[m++]).i);
    for (tagint &tag : partners[i]) tag = (tagint) ubuf(buf[m++]).i;
  }
  note_arrived(i);
  return m;
}

/* ----------------------------------------------------------------------
   restart: totals and the highest ID ever used; particle counts follow from the masses. The number of totals goes ahead,
   in bits that no earlier layout has there.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::write_restart(FILE *fp)
{
  double state[NTOTALS + 2];
  state[0] = ubuf(NTOTALS).d;
  MPI_Reduce(totals, state + 1, NTOTALS, MPI_DOUBLE, MPI_SUM, 0, world);
  state[NTOTALS + 1] = ubuf(newborn_tags.highest_used()).d;
  if (comm->me == 0) {
    int size = sizeof(state);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(state, sizeof(state), 1, fp);
  }
}

void FixClusterBreakMerge::restart(char *buf)
{
  double state[NTOTALS + 2];
  memcpy(state, buf, sizeof(double));
  if (ubuf(state[0]).i != NTOTALS)
    error->all(FLERR, "Fix {} {}: the restart file was written by another version of this fix", style, id);
  memcpy(state, buf, sizeof(state));
  if (comm->me == 0) std::copy(state + 1, state + 1 + NTOTALS, totals);
  newborn_tags.raise((tagint) ubuf(state[NTOTALS + 1]).i);
}

int FixClusterBreakMerge::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  int m = 1;
  for (tagint tag : partners[i]) buf[m++] = ubuf(tag).d;
  return m;
}

void FixClusterBreakMerge::unpack_restart(int i, int nth)
{
  double **extra = atom->extra;
  int m = 0;
  for (int k = 0; k < nth; k++) m += static_cast<int>(extra[i][m]);
  partners[i].resize(static_cast<int>(extra[i][m]) - 1);
  for (tagint &tag : partners[i]) tag = (tagint) ubuf(extra[i][++m]).i;
}

int FixClusterBreakMerge::size_restart(int i)
{
  return 1 + static_cast<int>(partners[i].size());
}

// called on all ranks, but the file keeps the answer of the first: room for the clusters of all

int FixClusterBreakMerge::maxsize_restart()
{
  int mine = 0, most = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, static_cast<int>(partners[i].size()));
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return 1 + most;
}
