/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "newborn_tags.h"

#include "crystal_router.h"

#include "comm.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Rank r sorts the births whose keys lie in the r-th part of the range of keys; a prefix sum over the parts gives every
   birth its place in the order of all.
------------------------------------------------------------------------- */

void NewbornTags::assign(std::vector<Birth> &births, double range)
{
  bigint mine = 0, all = 0;
  for (const Birth &b : births) mine += b.newborns;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all == 0) return;
  check(all);

  const CrystalRouter router(world);
  std::vector<Birth> part(births);
  for (std::size_t k = 0; k < part.size(); k++) {
    part[k].from = comm->me;
    part[k].index = static_cast<int>(k);
    part[k].at =
        std::min(static_cast<int>(static_cast<double>(part[k].key) / range * comm->nprocs), comm->nprocs - 1);
  }
  router.route(part, &Birth::at);
  number(part);
  router.route(part, &Birth::from);
  for (const Birth &b : part) births[b.index].first = b.first;
  highest += static_cast<tagint>(all);
}

/* ---------------------------------------------------------------------- */

void NewbornTags::number(std::vector<Birth> &part) const
{
  std::sort(part.begin(), part.end(), [](const Birth &a, const Birth &b) { return a.key < b.key; });
  bigint mine = 0, before = 0;
  for (const Birth &b : part) mine += b.newborns;
  MPI_Exscan(&mine, &before, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (comm->me == 0) before = 0;
  tagint next = highest + 1 + static_cast<tagint>(before);
  for (Birth &b : part) {
    b.first = next;
    next += b.newborns;
  }
}

/* ---------------------------------------------------------------------- */

void NewbornTags::check(bigint n) const
{
  if (highest + n >= MAXTAGINT)    // the engine takes no atom with the highest number itself
    error->all(FLERR,
               "Newborn clusters would need the atom ID {}, above the largest of this LAMMPS "
               "build ({}): build with -DLAMMPS_SIZES=bigbig",
               highest + n, MAXTAGINT);
}
