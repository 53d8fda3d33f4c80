/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "cluster_table.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void ClusterTable::Shown::grow(int n)
{
  numbers.resize(static_cast<std::size_t>(n) * columns);
  rows.resize(n);
  for (int row = 0; row < n; row++) rows[row] = &numbers[static_cast<std::size_t>(row) * columns];
}

/* ---------------------------------------------------------------------- */

bool ClusterTable::keeps_any() const
{
  for (const auto &column : columns)
    if (column->life == KEPT) return true;
  return false;
}

bool ClusterTable::has_lists() const
{
  for (const auto &column : columns)
    if (column->life != SCRATCH && column->varies()) return true;
  return false;
}

void ClusterTable::grow(int rows)
{
  for (const auto &column : columns) column->grow(rows);
}

void ClusterTable::copy(int from, int to)
{
  for (const auto &column : columns)
    if (column->life != SCRATCH) column->copy(from, to);
}

void ClusterTable::clear(int row)
{
  for (const auto &column : columns) column->clear(row);
}

/* ---------------------------------------------------------------------- */

int ClusterTable::size(int row, Life least) const
{
  int n = 0;
  for (const auto &column : columns)
    if (column->life >= least) n += column->size(row);
  return n;
}

int ClusterTable::pack(int row, double *to, Life least) const
{
  int n = 0;
  for (const auto &column : columns)
    if (column->life >= least) n += column->pack(row, to + n);
  return n;
}

int ClusterTable::unpack(int row, const double *from, Life least)
{
  int n = 0;
  for (const auto &column : columns)
    if (column->life >= least) n += column->unpack(row, from + n);
  return n;
}

double ClusterTable::bytes() const
{
  double sum = 0.0;
  for (const auto &column : columns) sum += column->bytes();
  return sum;
}
