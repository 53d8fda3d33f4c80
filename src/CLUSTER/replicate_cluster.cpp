/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "replicate_cluster.h"

#include "style_arguments.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "irregular.h"

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   Each rank makes all copies of its own clusters, wherever they belong, and the ranks then hand them over: the work and
   the memory of a rank are its share of the result, and no rank hears of the clusters of all.
------------------------------------------------------------------------- */

void ReplicateCluster::command(int narg, char **arg)
{
  if (!domain->box_exist) error->all(FLERR, "Replicate/cluster command before simulation box is defined");
  StyleArguments args(lmp, "replicate/cluster", narg, arg);
  int copies[3];
  for (int axis = 0; axis < 3; axis++) copies[axis] = args.integer(fmt::format("n{}", "xyz"[axis]), 1);
  if (args.more()) {
    args.word("nothing");
    args.unknown_keyword();
  }
  refuse_what_has_more_than_clusters();

  const double all = static_cast<double>(copies[0]) * copies[1] * copies[2];
  const tagint highest = highest_tag();
  if (all * static_cast<double>(highest) >= static_cast<double>(MAXTAGINT))
    error->all(
        FLERR,
        "Replicate/cluster: {:g} copies of IDs up to {} would need IDs above the largest of this LAMMPS build "
        "({}): build with -DLAMMPS_SIZES=bigbig",
        all, highest, MAXTAGINT);
  int too_many = all * atom->nlocal >= MAXSMALLINT, any;
  MPI_Allreduce(&too_many, &any, 1, MPI_INT, MPI_MAX, world);
  if (any) error->all(FLERR, "Replicate/cluster: more than {} clusters of one rank: use more ranks", MAXSMALLINT);

  copy_mine(copies, highest);
  atom->natoms *= static_cast<bigint>(all);
  enlarge_box(copies);

  bigint mine = atom->nlocal, found;
  MPI_Allreduce(&mine, &found, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (found != atom->natoms)
    error->all(FLERR, "Replicate/cluster: {} clusters instead of {}", found, atom->natoms);
  if (comm->me == 0) utils::logmesg(lmp, "  {} clusters in {:g} copies of the box\n", atom->natoms, all);
}

/* ---------------------------------------------------------------------- */

void ReplicateCluster::refuse_what_has_more_than_clusters()
{
  if (domain->triclinic) error->all(FLERR, "Replicate/cluster does not support triclinic boxes");
  if (atom->molecular != Atom::ATOMIC)
    error->all(FLERR, "Replicate/cluster: atom style {} has bonds", atom->atom_style);
  if (atom->nextra_grow || atom->nextra_restart || atom->nextra_store)
    error->all(FLERR, "Replicate/cluster: a fix keeps something per cluster already: give it before any fix");
  if (comm->layout == Comm::LAYOUT_TILED) error->all(FLERR, "Replicate/cluster: give it before balance … rcb");
}

tagint ReplicateCluster::highest_tag()
{
  tagint mine = 0, all = 0;
  if (atom->tag_enable)
    for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, atom->tag[i]);
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  return all;
}

/* ----------------------------------------------------------------------
   all copies of owned clusters, at their places in the larger box
------------------------------------------------------------------------- */

void ReplicateCluster::copy_mine(const int *copies, tagint highest)
{
  const int originals = atom->nlocal;
  const imageint home = ((imageint) IMGMAX << IMG2BITS) | ((imageint) IMGMAX << IMGBITS) | IMGMAX;
  for (int i = 0; i < originals; i++) {
    domain->remap(atom->x[i], atom->image[i]);
    atom->image[i] = home;
  }
  // ghosts go, and the map of IDs with them while it still is that of these clusters: new ones lie beyond its end
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
  atom->avec->grow(originals * copies[0] * copies[1] * copies[2]);    // at once, not a slice at a time
  tagint copy = 0;
  for (int k = 0; k < copies[2]; k++)
    for (int j = 0; j < copies[1]; j++)
      for (int i = 0; i < copies[0]; i++, copy++) {
        if (copy == 0) continue;    // these are there
        const double shift[3] = {i * domain->prd[0], j * domain->prd[1], k * domain->prd[2]};
        for (int original = 0; original < originals; original++) {
          const int m = atom->nlocal;
          atom->avec->create_atom(atom->type[original], atom->x[original]);
          atom->avec->copy(original, m, 0);
          for (int axis = 0; axis < 3; axis++) atom->x[m][axis] += shift[axis];
          if (atom->tag_enable) atom->tag[m] += copy * highest;
        }
      }
}

/* ---------------------------------------------------------------------- */

void ReplicateCluster::enlarge_box(const int *copies)
{
  for (int axis = 0; axis < 3; axis++)
    domain->boxhi[axis] = domain->boxlo[axis] + copies[axis] * domain->prd[axis];
  domain->set_initial_box();
  domain->set_global_box();
  comm->set_proc_grid();
  domain->set_local_box();
  for (int i = 0; i < atom->nlocal; i++) domain->remap(atom->x[i], atom->image[i]);    // rounding at the last edge
  if (atom->map_style != Atom::MAP_NONE) {    // of all copies, as the migration expects it
    atom->map_init();
    atom->map_set();
  }
  Irregular irregular(lmp);
  irregular.migrate_atoms(1);
}
