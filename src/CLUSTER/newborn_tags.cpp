/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "newborn_tags.h"

#include "comm.h"
#include "error.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Rank r sorts the births whose parents' IDs lie in the r-th part of the range of IDs; a prefix sum
   over the parts gives every birth its place in the order of all parents.
------------------------------------------------------------------------- */

void NewbornTags::assign(std::vector<Birth> &births)
{
  bigint mine = 0, all = 0;
  for (const Birth &b : births) mine += b.newborns;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all == 0) return;
  check(all);

  std::vector<int> procs;
  for (std::size_t k = 0; k < births.size(); k++) {
    births[k].proc = comm->me;
    births[k].index = static_cast<int>(k);
    procs.push_back(
        static_cast<int>((births[k].parent - 1) * static_cast<bigint>(comm->nprocs) / MAX(highest, 1)));
    procs.back() = std::min(std::max(procs.back(), 0), comm->nprocs - 1);
  }

  char *out = nullptr;
  const int n = comm->rendezvous(0, static_cast<int>(births.size()), (char *) births.data(), sizeof(Birth), 0,
                                 procs.data(), number_bucket, 0, out, sizeof(Birth), this);
  const Birth *numbered = (const Birth *) out;
  for (int k = 0; k < n; k++) births[numbered[k].index].first = numbered[k].first;
  memory->sfree(out);
  take(all);
}

/* ---------------------------------------------------------------------- */

tagint NewbornTags::take(bigint n)
{
  check(n);
  highest += static_cast<tagint>(n);
  return highest - static_cast<tagint>(n);
}

void NewbornTags::check(bigint n) const
{
  if (highest + n >= MAXTAGINT)    // the engine takes no atom with the highest number itself
    error->all(FLERR,
               "Newborn clusters would need the atom ID {}, above the largest of this LAMMPS "
               "build ({}): build with -DLAMMPS_SIZES=bigbig",
               highest + n, MAXTAGINT);
}

/* ---------------------------------------------------------------------- */

int NewbornTags::number_bucket(int n, char *inbuf, int &flag, int *&procs, char *&outbuf, void *ptr)
{
  auto self = (NewbornTags *) ptr;
  auto births = (Birth *) inbuf;
  std::sort(births, births + n, [](const Birth &a, const Birth &b) { return a.parent < b.parent; });

  bigint mine = 0, before = 0;
  for (int k = 0; k < n; k++) mine += births[k].newborns;
  MPI_Exscan(&mine, &before, 1, MPI_LMP_BIGINT, MPI_SUM, self->world);
  if (self->comm->me == 0) before = 0;

  self->memory->create(procs, MAX(n, 1), "newborn_tags:procs");
  tagint next = self->highest + 1 + static_cast<tagint>(before);
  for (int k = 0; k < n; k++) {
    births[k].first = next;
    next += births[k].newborns;
    procs[k] = births[k].proc;
  }
  outbuf = inbuf;
  flag = 1;
  return n;
}
