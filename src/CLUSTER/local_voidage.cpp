/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "local_voidage.h"

#include "style_arguments.h"

#include "model/drag_law.h"

#include "atom.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void LocalVoidage::parse(StyleArguments &args)
{
  given = true;
  double all = 1.0;
  for (int &n : counts) all *= n = args.integer("law cells", 1);
  if (all > CellAverages::MOST)
    args.refuse("law cells", fmt::format("at most {} cells in all", CellAverages::MOST));
}

void LocalVoidage::add_columns(ClusterTable &table)
{
  if (given) last = &table.add<Voidage>(ClusterTable::CARRIED);
}

void LocalVoidage::make_cells(Fix *owner)
{
  if (given) sums = std::make_unique<CellAverages>(lmp, owner, counts, 1);
}

/* ---------------------------------------------------------------------- */

void LocalVoidage::measure()
{
  if (!given) return;
  sums->clear();
  for (int i = 0; i < atom->nlocal; i++) sums->add(atom->x[i], 0, sphere_volume(2.0 * atom->radius[i]));
  sums->sum();
  const double volume = sums->cell_volume();
  for (int i = 0; i < atom->nlocal; i++) (*last)[i].value = voidage_of(sums->total(atom->x[i], 0), volume);
}
