/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "cell_averages.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "grid3d.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

CellAverages::CellAverages(LAMMPS *lmp, Fix *f, const int *ncells, int values) :
    Pointers(lmp), fix(f), n{ncells[0], ncells[1], ncells[2]}, nvalues(values), grid(nullptr)
{
  reset();
}

CellAverages::~CellAverages()
{
  delete grid;
}

/* ---------------------------------------------------------------------- */

void CellAverages::reset()
{
  delete grid;
  grid = new Grid3d(lmp, world, n[0], n[1], n[2]);
  grid->set_distance(neighbor->skin);    // clusters drift by up to half the skin, plus one step
  int in[6];
  grid->setup_grid(in[0], in[1], in[2], in[3], in[4], in[5], lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]);
  int n1, n2;
  grid->setup_comm(n1, n2);
  buf1.resize(static_cast<std::size_t>(n1) * nvalues + 1);
  buf2.resize(static_cast<std::size_t>(n2) * nvalues + 1);
  std::size_t total = nvalues;
  for (int k = 0; k < 3; k++) total *= hi[k] - lo[k] + 1;
  cells.assign(total, 0.0);
}

void CellAverages::clear()
{
  std::fill(cells.begin(), cells.end(), 0.0);
}

/* ----------------------------------------------------------------------
   cell by the same rule as the grid itself: no wrap, ghost cells lie outside 0 .. n-1
------------------------------------------------------------------------- */

std::size_t CellAverages::offset(const double *x) const
{
  int index[3];
  for (int k = 0; k < 3; k++) {
    const double share = (x[k] - domain->boxlo[k]) / domain->prd[k];
    index[k] = static_cast<int>(std::floor(share * n[k]));
    if (!domain->periodicity[k]) index[k] = std::min(std::max(index[k], 0), n[k] - 1);
    if (index[k] < lo[k] || index[k] > hi[k])
      error->one(FLERR, "A cluster at {} {} {} lies outside of the cells of its rank", x[0], x[1], x[2]);
    index[k] -= lo[k];
  }
  const std::size_t width = hi[0] - lo[0] + 1, depth = hi[1] - lo[1] + 1;
  return nvalues * ((index[2] * depth + index[1]) * width + index[0]);
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
  grid->reverse_comm(Grid3d::FIX, fix, 0, nvalues, sizeof(double), buf1.data(), buf2.data(), MPI_DOUBLE);
  grid->forward_comm(Grid3d::FIX, fix, 0, nvalues, sizeof(double), buf1.data(), buf2.data(), MPI_DOUBLE);
}

double CellAverages::cell_volume() const
{
  return domain->prd[0] * domain->prd[1] * domain->prd[2] / (static_cast<double>(n[0]) * n[1] * n[2]);
}

double CellAverages::memory_usage() const
{
  return sizeof(double) * static_cast<double>(cells.size() + buf1.size() + buf2.size());
}

/* ---------------------------------------------------------------------- */

void CellAverages::pack(double *buf, int nlist, const int *list) const
{
  for (int k = 0; k < nlist; k++)
    for (int v = 0; v < nvalues; v++) *buf++ = cells[static_cast<std::size_t>(nvalues) * list[k] + v];
}

void CellAverages::unpack(const double *buf, int nlist, const int *list, bool add_up)
{
  for (int k = 0; k < nlist; k++)
    for (int v = 0; v < nvalues; v++, buf++) {
      double &cell = cells[static_cast<std::size_t>(nvalues) * list[k] + v];
      cell = (add_up ? cell : 0.0) + *buf;
    }
}
