/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "held_drag.h"

#include "four_clusters.h"

#include "atom.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

bool DragTotals::finite() const
{
  return std::isfinite(force[0] + force[1] + force[2]);
}

/* ---------------------------------------------------------------------- */

void HeldDrag::hold_for(int steps, ClusterTable &table)
{
  refresh = steps;
  if (refresh == 1) return;
  u = &table.add<Vec3>(ClusterTable::SCRATCH);
  b = &table.add<double>(ClusterTable::SCRATCH);
}

bool HeldDrag::due() const
{
  return refresh == 1 || update->setupflag || neighbor->ago == 0 || update->ntimestep % refresh == 0 ||
      dt != update->dt;
}

void HeldDrag::start()
{
  dt = update->dt;
}

bool HeldDrag::hand_over()
{
  elsewhere = !due();
  return elsewhere;
}

bool HeldDrag::handed_over()
{
  const bool was = elsewhere;
  elsewhere = false;
  return was;
}

/* ---------------------------------------------------------------------- */

DragTotals HeldDrag::add() const
{
  const int nlocal = atom->nlocal;
  const double *v = nlocal ? atom->v[0] : nullptr;
  double *f = nlocal ? atom->f[0] : nullptr;
  const double *held_u = velocity(), *held_b = coefficient();
  DragTotals sum;
  int i = 0;
#ifdef CLUSTER_PACKS
  const Fourfold along_all(along);
  Pack forces[3] = {}, powers = {};
  for (; i + 4 <= nlocal; i += 4) {
    const Threefold coefficients(load(held_b + i));
    for (int part = 0; part < 3; part++) {
      const int m = 3 * i + 4 * part;
      const Pack speed = load(v + m);
      const Pack drag =
          ClusterDEM::held_drag(along_all.part[part], coefficients.part[part], load(held_u + m), speed);
      store(f + m, load(f + m) + drag);
      forces[part] += drag;
      powers += drag * speed;
    }
  }
  for (int m = 0; m < 12; m++) sum.force[m % 3] += forces[m / 4][m % 4];
  for (int m = 0; m < 4; m++) sum.power += powers[m];
#endif
  for (; i < nlocal; i++)
    for (int k = 0; k < 3; k++) {
      const double drag = ClusterDEM::held_drag(along[k], held_b[i], held_u[3 * i + k], v[3 * i + k]);
      f[3 * i + k] += drag;
      sum.force[k] += drag;
      sum.power += drag * v[3 * i + k];
    }
  return sum;
}
