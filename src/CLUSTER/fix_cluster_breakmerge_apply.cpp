/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The events themselves: clusters change, are born and vanish, before atoms migrate.

#include "fix_cluster_breakmerge.h"

#include "fix_drag_cluster.h"

#include "atom.h"
#include "atom_vec.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::pre_exchange()
{
  if (test == CONTACT_ENDED)
    maxexchange = size_peratom_cols + 1 + maxsize_restart();    // migration carries the contacts, too
  if (next_reneighbor != update->ntimestep) return;
  output_step = -1;

  std::vector<NewbornTags::Birth> births;
  for (const Event &e : events)
    if (e.plan.pieces() > 1) births.push_back({static_cast<std::uint64_t>(atom->tag[e.i]), e.plan.pieces() - 1});
  newborn_tags.assign(births, newborn_tags.highest_used() + 1.0);

  // newborns overwrite ghosts, so forget those first
  atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();

  const int nlocal_before = atom->nlocal;
  std::size_t birth = 0;
  for (const Event &e : events) {
    const int pieces = e.plan.pieces();
    if (e.j >= 0) {
      totals[MERGES]++;
      totals[E_LOST] += e.energy_lost;
      totals[E_BORN] += e.energy_born;
      if (e.needs & NEEDS_ST) totals[MERGES_BY_ST]++;
      if (e.needs & NEEDS_MF) totals[MERGES_BY_MF]++;
      if (atom->omega_flag)
        for (int axis = 0; axis < 3; axis++) atom->omega[e.i][axis] = e.omega[axis];
    }
    if (pieces > 1) {
      totals[BREAKUPS]++;
      totals[BORN] += pieces;
      if (e.j < 0) note_breakup(e.i);
      create_fragments(e, births[birth++].first);
    } else become(e.i, e.plan.n, e.body.x, e.body.v);
  }
  delete_dying();
  events.clear();

  // what the events made, not a recount: clusters that left the box must stay missing in the engine's own test
  bigint made = atom->nlocal - nlocal_before, made_all = 0;
  MPI_Allreduce(&made, &made_all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  atom->natoms += made_all;
  if (atom->natoms < 0 || atom->natoms >= MAXBIGINT) error->all(FLERR, "Fix {} {}: too many clusters", style, id);
  atom->map_init();
  atom->map_set();
}

/* ----------------------------------------------------------------------
   owned cluster i, changed or newborn, holds n particles from now on
------------------------------------------------------------------------- */

void FixClusterBreakMerge::become(int i, int n, const Vec3 &x, const Vec3 &v)
{
  for (int axis = 0; axis < 3; axis++) {
    atom->x[i][axis] = x[axis];
    atom->v[i][axis] = v[axis];
  }
  atom->radius[i] = 0.5 * geometry(i).diameter(n);
  atom->rmass[i] = geometry(i).mass(n);
  count[i] = n;
  array_atom[i][0] = n;
  array_atom[i][1] = geometry(i).diameter(n);
  if (test == CONTACT_ENDED) partners[i].clear();
  for (auto &fix : modify->get_fix_by_style("^drag/cluster")) static_cast<FixDragCluster *>(fix)->redraw(i);
}

/* ----------------------------------------------------------------------
   the parent becomes the first piece; the others are new, with its velocity and all else
------------------------------------------------------------------------- */

void FixClusterBreakMerge::create_fragments(const Event &e, tagint first)
{
  const int i = e.i;
  for (int piece = 1; piece < e.plan.pieces(); piece++) {
    Vec3 x = e.body.x + e.placement.centres[piece];
    atom->avec->create_atom(atom->type[i], x.data());
    const int m = atom->nlocal - 1;
    atom->tag[m] = first + piece - 1;
    atom->mask[m] = atom->mask[i];
    atom->image[m] = atom->image[i];
    if (atom->omega_flag)
      for (int axis = 0; axis < 3; axis++) atom->omega[m][axis] = atom->omega[i][axis];
    modify->create_attribute(m);
    for (int column = 0; column < size_peratom_cols; column++) array_atom[m][column] = array_atom[i][column];
    become(m, e.plan.particles(piece), x, e.body.v);
  }
  become(i, e.plan.particles(0), e.body.x + e.placement.centres[0], e.body.v);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::delete_dying()
{
  std::sort(dying.begin(), dying.end());
  merging_now = true;
  for (auto j = dying.rbegin(); j != dying.rend(); ++j) {
    atom->avec->copy(atom->nlocal - 1, *j, 1);
    atom->nlocal--;
  }
  merging_now = false;
  dying.clear();
}
