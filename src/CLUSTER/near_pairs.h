/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The one walk over the half neighbor lists of pair styles, in LAMMPS and LIGGGHTS.

#ifndef LMP_NEAR_PAIRS_H
#define LMP_NEAR_PAIRS_H

#include "atom.h"
#include "neigh_list.h"
#include "pair.h"

#include "model/vector3.h"

namespace LAMMPS_NS {

// Calls visit(i, j, slot, d) for every pair of neighbors of the pair style: i is owned, j its neighbor number `slot`,
// d = x_i - x_j.
template <class Visit> void each_near_pair(const Atom *atom, const Pair *pair, Visit visit)
{
  using namespace ClusterDEM;
  double **x = atom->x;
  const NeighList *list = pair->list;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int *jlist = list->firstneigh[i];
    const Vec3 xi = to_vec3(x[i]);
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = jlist[jj] & NEIGHMASK;
      visit(i, j, jj, xi - to_vec3(x[j]));
    }
  }
}

}    // namespace LAMMPS_NS
#endif
