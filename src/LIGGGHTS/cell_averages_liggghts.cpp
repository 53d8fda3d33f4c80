/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// LIGGGHTS has no distributed grids: every rank holds all cells.

#include "cell_averages.h"

#include "domain.h"
#include "model/gas_field.h"

#include <algorithm>

using namespace LAMMPS_NS;

CellAverages::CellAverages(LAMMPS *lmp, Fix *f, const int *ncells, int values) :
    Pointers(lmp), fix(f), n{ncells[0], ncells[1], ncells[2]}, nvalues(values), grid(nullptr), lo{}, hi{}
{
  reset();
}

CellAverages::~CellAverages() {}

void CellAverages::reset()
{
  cells.assign(static_cast<std::size_t>(nvalues) * n[0] * n[1] * n[2], 0.0);
}

void CellAverages::clear()
{
  std::fill(cells.begin(), cells.end(), 0.0);
}

std::size_t CellAverages::offset(const double *x) const
{
  std::size_t cell = 0;
  for (int k = 2; k >= 0; k--)
    cell = cell * n[k] + ClusterDEM::cell_index((x[k] - domain->boxlo[k]) / domain->prd[k], n[k]);
  return nvalues * cell;
}

void CellAverages::add(const double *x, int value, double amount)
{
  cells[offset(x) + value] += amount;
}

double CellAverages::total(const double *x, int value) const
{
  return cells[offset(x) + value];
}

void CellAverages::sum()
{
  MPI_Allreduce(MPI_IN_PLACE, cells.data(), static_cast<int>(cells.size()), MPI_DOUBLE, MPI_SUM, world);
}

double CellAverages::cell_volume() const
{
  return domain->prd[0] * domain->prd[1] * domain->prd[2] / (static_cast<double>(n[0]) * n[1] * n[2]);
}

double CellAverages::memory_usage() const
{
  return sizeof(double) * static_cast<double>(cells.size());
}

void CellAverages::pack(double *, int, const int *) const {}
void CellAverages::unpack(const double *, int, const int *, bool) {}
