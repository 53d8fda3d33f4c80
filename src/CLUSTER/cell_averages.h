/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Sums over the clusters in the cells of a regular grid over the box, for the readings of the size law that ask for the mean of
// a cell, and for the voidage of drag laws. Each rank holds the cells of its own part of the box.

#ifndef LMP_CELL_AVERAGES_H
#define LMP_CELL_AVERAGES_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {
class Fix;
class Grid3d;

class CellAverages : protected Pointers {
 public:
  static constexpr int MOST = 100000000;    // cells in all: 0.8 GB for each value

  // fix: the owner, whose grid callbacks end in pack() and unpack(); so many values per cell
  CellAverages(class LAMMPS *lmp, Fix *fix, const int *cells, int nvalues);
  ~CellAverages() override;

  void reset();    // the box or its division among the ranks has changed
  void clear();
  void add(const double *x, int value, double amount);
  void sum();    // collective: after it, every cell that an owned cluster lies in holds its total
  double total(const double *x, int value) const;
  double cell_volume() const;
  double memory_usage() const;

  void pack(double *buf, int nlist, const int *list) const;
  void unpack(const double *buf, int nlist, const int *list, bool add_up);

 private:
  Fix *fix;
  int n[3], nvalues;
  Grid3d *grid;
  int lo[3], hi[3];    // cells that this rank stores, ghosts included
  std::vector<double> cells, buf1, buf2;

  std::size_t offset(const double *x) const;
};

}    // namespace LAMMPS_NS
#endif
