/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "newborn_tags.h"

#include "comm.h"
#include "engine.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   every rank learns of all births: LIGGGHTS has no rendezvous
------------------------------------------------------------------------- */

void NewbornTags::assign(std::vector<Birth> &births)
{
  int mine = 2 * static_cast<int>(births.size());
  std::vector<int> sizes(comm->nprocs), offsets(comm->nprocs, 0), out;
  MPI_Allgather(&mine, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  std::partial_sum(sizes.begin(), sizes.end() - 1, offsets.begin() + 1);
  for (const Birth &b : births) {
    out.push_back(b.parent);
    out.push_back(b.newborns);
  }
  std::vector<int> in(offsets.back() + sizes.back());
  MPI_Allgatherv(out.data(), mine, MPI_INT, in.data(), sizes.data(), offsets.data(), MPI_INT, world);

  std::vector<std::pair<tagint, tagint>> all;    // parent, newborns; then parent, first ID
  bigint newborns = 0;
  for (std::size_t k = 0; k < in.size(); k += 2) {
    all.push_back({in[k], in[k + 1]});
    newborns += in[k + 1];
  }
  check(newborns);
  std::sort(all.begin(), all.end());
  for (auto &[parent, number] : all) {
    const tagint first = highest + 1;
    highest += number;
    number = first;
  }
  for (Birth &b : births)
    b.first = std::lower_bound(all.begin(), all.end(), std::pair<tagint, tagint>(b.parent, 0))->second;
}

tagint NewbornTags::take(bigint n)
{
  check(n);
  highest += static_cast<tagint>(n);
  return highest - static_cast<tagint>(n);
}

void NewbornTags::check(bigint n) const
{
  if (highest + n >= MAXTAGINT)
    ErrorWords(error).all(FLERR, "Newborn clusters would need the atom ID {}, above the largest of LIGGGHTS ({})",
                          highest + n, MAXTAGINT);
}

int NewbornTags::number_bucket(int, char *, int &, int *&, char *&, void *)
{
  return 0;    // of LAMMPS' rendezvous
}
