/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Clusters that other commands let in or take out, such as fix deposit, fix pour, fix evaporate, delete_atoms or an
// open side of the box: how many particles they hold, and which IDs the new ones have.

#include "fix_cluster_breakmerge.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"

#include <cmath>
#include <cstdint>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   Events are decided before pre_exchange, with the clusters and the places that there are then. Fixes that add, delete
   or move clusters between ranks do so in pre_exchange, too: they must find the events done.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::check_order()
{
  bool after_me = false;
  for (const auto &fix : modify->get_fix_list()) {
    const bool history = utils::strmatch(fix->id, "^NEIGH_HISTORY");
    if (fix == this) after_me = true;
    else if (after_me && history)
      error->all(FLERR,
                 "Fix {} {} must be defined after the pair_style command: contact history is saved "
                 "in the order of definition",
                 style, id);
    else if (!after_me && !history && fix->force_reneighbor && (fix->setmask() & PRE_EXCHANGE))
      error->all(
          FLERR,
          "Fix {} {} must be defined before fix {} {}: breakups and merges of a step are carried out before "
          "other fixes add, delete or migrate clusters",
          style, id, fix->style, fix->id);
  }
}

/* ----------------------------------------------------------------------
   at the start of every run: the whole number of particles in each cluster, the highest ID
------------------------------------------------------------------------- */

void FixClusterBreakMerge::setup_pre_exchange()
{
  tagint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    mine = MAX(mine, atom->tag[i]);
    if (!(atom->mask[i] & groupbit)) continue;
    const int before = count[i];
    count[i] = 0;    // a set command may have changed it
    const int change = particle_count(i) - before;
    if (!start_counted) continue;
    if (before == 0) totals[CLUSTERS_FED]++;
    totals[change > 0 ? FED : LEFT] += std::abs(change);
  }
  start_counted = true;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  newborn_tags.raise(all);
  check_part_of_box();
}

/* ----------------------------------------------------------------------
   the box and its division among the ranks may change at any rebuild, and so may the clusters
------------------------------------------------------------------------- */

void FixClusterBreakMerge::pre_neighbor()
{
  check_part_of_box();
  welcome();
}

void FixClusterBreakMerge::check_part_of_box()
{
  for (int axis = 0; axis < 3; axis++) {
    const double part = domain->subhi[axis] - domain->sublo[axis];
    if (part < claim_max && part < domain->prd[axis] * (1.0 - 1.0e-12))
      error->one(FLERR,
                 "Fix {} {}: a rank's part of the box is {} long along {}, below the claim {}: use "
                 "fewer ranks or a smaller claim",
                 style, id, part, "xyz"[axis], claim_max);
    if (domain->periodicity[axis] && !(planar && axis == 1) && domain->prd[axis] < 4.0 * claim_max)
      error->one(FLERR,
                 "Fix {} {}: the periodic box is {} long along {}, below four times the claim {}: an "
                 "event would meet its own image",
                 style, id, domain->prd[axis], "xyz"[axis], claim_max);
  }
}

/* ----------------------------------------------------------------------
   Clusters that came in since the last rebuild: count them, and number them above every ID ever used, in an order that
   hangs on their places alone, whatever IDs they brought: those may have belonged to others, or depend on the ranks.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::welcome()
{
  std::vector<int> mine;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && count[i] == 0) mine.push_back(i);
  const int some = !mine.empty();
  int any;
  MPI_Allreduce(&some, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;

  pairs.check_cutoff(fmt::format("Fix {} {}", style, id), groupbit, largest_diameter());
  for (const int i : mine) {
    totals[FED] += particle_count(i);
    totals[CLUSTERS_FED]++;
  }
  output_step = -1;
  number_by_place(mine);
}

/* ----------------------------------------------------------------------
   Places mixed to numbers that are spread evenly wherever the clusters came in, so that the ranks share the work. Of a
   place only what rounding does not touch counts.
------------------------------------------------------------------------- */

static std::uint64_t mixed(std::uint64_t z)
{
  z += 0x9e3779b97f4a7c15u;    // splitmix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

void FixClusterBreakMerge::number_by_place(const std::vector<int> &mine)
{
  static constexpr double FINEST = 4294967296.0;    // parts of the box along an axis
  std::vector<NewbornTags::Birth> births;
  for (const int i : mine) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; axis++) {
      const double share = (atom->x[i][axis] - domain->boxlo[axis]) / domain->prd[axis];
      key = mixed(key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(share * FINEST)));
    }
    births.push_back({key, 1});
  }
  newborn_tags.assign(births, FINEST * FINEST);

  atom->map_clear();
  for (std::size_t k = 0; k < mine.size(); k++) atom->tag[mine[k]] = births[k].first;
  exchange(IDS, 1);
  atom->map_init();
  atom->map_set();
}

/* ----------------------------------------------------------------------
   The engine deletes clusters by copying another one over them, and so it does with those that it has packed for
   another rank: what is deleted and unpacked nowhere has left.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::note_deleted(int i)
{
  if (count[i] == 0 || merging_now) return;
  totals[LEFT] += count[i];
  totals[CLUSTERS_LEFT]++;
  output_step = -1;
}

void FixClusterBreakMerge::note_arrived(int i)
{
  if (count[i] == 0) return;
  totals[LEFT] -= count[i];
  totals[CLUSTERS_LEFT]--;
}
