/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The voidage where a cluster is: of the cell of a regular grid over the box that its centre lies in. Clusters, and whatever
// else has a diameter, count as spheres.

#ifndef LMP_LOCAL_VOIDAGE_H
#define LMP_LOCAL_VOIDAGE_H

#include "engine.h"

#include "cell_averages.h"
#include "cluster_table.h"

#include <memory>

namespace LAMMPS_NS {
class StyleArguments;

class LocalVoidage : protected EnginePointers {
 public:
  LocalVoidage(class LAMMPS *lmp) : EnginePointers(lmp), given(false), counts{1, 1, 1}, last(nullptr) {}

  void parse(StyleArguments &);    // nx ny nz
  void forget() { given = false; }
  bool any() const { return given; }
  void add_columns(ClusterTable &);
  void make_cells(class Fix *owner);    // at the start of a run
  CellAverages *cells() { return sums.get(); }

  void measure();                                        // collective
  double at(int i) const { return (*last)[i].value; }    // of owned cluster i, as last measured

 private:
  bool given;
  int counts[3];
  std::unique_ptr<CellAverages> sums;
  struct Voidage {
    double value = 1.0;
  };
  ClusterTable::Values<Voidage> *last;    // newborns have that of their parent
};

}    // namespace LAMMPS_NS
#endif
