/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What fix cluster/breakmerge keeps per cluster, and in which columns users see it.

#ifndef LMP_CLUSTER_COLUMNS_H
#define LMP_CLUSTER_COLUMNS_H

#include "engine.h"

#include "cluster_table.h"
#include "model/decisive_terms.h"

namespace LAMMPS_NS {

struct ClusterColumns {
  // of the per-atom array: particles, d, l, N_st, N_cc, N_smf
  enum { N, D, L, ST, CC, MF, NCOLUMNS };

  ClusterTable::Values<tagint> *seen;    // the ID that an atom of any group had at the last look; 0: none yet
  ClusterTable::Values<int> *count;      // primary particles; 0: not yet known
  ClusterTable::Shown *shown;
  ClusterTable::Lists<tagint> *partners;    // in contact at the last test (test end only)
  ClusterTable::Values<int>
      *postponed;    // wanted to break at the last check, found no room (not with test always)

  ClusterDEM::PowerParts power(int i) const
  {
    const double *row = (*shown)[i];
    return {row[ST], row[CC], row[MF]};
  }
  double diameter(int i) const { return (*shown)[i][D]; }
  double stable_diameter(int i) const { return (*shown)[i][L]; }

  // cluster i holds n particles from now on
  void set_count(int i, int n, double diameter) const
  {
    (*count)[i] = n;
    (*shown)[i][N] = n;
    (*shown)[i][D] = diameter;
    if (partners) (*partners)[i].clear();
    if (postponed) (*postponed)[i] = 0;
  }
};

}    // namespace LAMMPS_NS
#endif
