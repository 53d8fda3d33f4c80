/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Drag between two refreshes: gas velocity and coefficient of each cluster are held.

#include "fix_drag_cluster.h"

#include "four_clusters.h"

#include "atom.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ----------------------------------------------------------------------
   Between two refreshes the gas velocity and the coefficient of each cluster are held; slots of the atom arrays change
   hands only when the neighbor lists are rebuilt, and then all is computed anew.
------------------------------------------------------------------------- */

bool FixDragCluster::due() const
{
  return refresh == 1 || update->setupflag || neighbor->ago == 0 || update->ntimestep % refresh == 0 ||
      held_dt != update->dt;
}

bool FixDragCluster::hand_over()
{
  handed_over = !due();
  return handed_over;
}

bool FixDragCluster::add_held_drag()
{
  if (any_variable()) modify->addstep_compute(update->ntimestep + 1);    // the lists may be rebuilt at any step
  const int nlocal = atom->nlocal;
  const double *v = nlocal ? atom->v[0] : nullptr;
  double *f = nlocal ? atom->f[0] : nullptr;
  const Vec3 along = in_plane({1.0, 1.0, 1.0});
  double force[3] = {0.0, 0.0, 0.0}, power = 0.0;
  int i = 0;
#ifdef CLUSTER_PACKS
  const Fourfold along_all(along);
  Pack forces[3] = {}, powers = {};
  for (; i + 4 <= nlocal; i += 4) {
    const Threefold b(load(&held_b[i]));
    for (int part = 0; part < 3; part++) {
      const int m = 3 * i + 4 * part;
      const Pack speed = load(v + m);
      const Pack drag = held_drag(along_all.part[part], b.part[part], load(&held_u[m]), speed);
      store(f + m, load(f + m) + drag);
      forces[part] += drag;
      powers += drag * speed;
    }
  }
  for (int m = 0; m < 12; m++) force[m % 3] += forces[m / 4][m % 4];
  for (int m = 0; m < 4; m++) power += powers[m];
#endif
  for (; i < nlocal; i++)
    for (int k = 0; k < 3; k++) {
      const double drag = held_drag(along[k], held_b[i], held_u[3 * i + k], v[3 * i + k]);
      f[3 * i + k] += drag;
      force[k] += drag;
      power += drag * v[3 * i + k];
    }
  for (int k = 0; k < 3; k++) totals[k] = force[k];
  totals[3] = power;
  return std::isfinite(force[0] + force[1] + force[2]);
}
