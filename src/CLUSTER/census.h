/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What has happened since the fix was defined, on this rank: events, energies, what came in and left, what decided. Sums over
// the ranks are the fix's output.

#ifndef LMP_CENSUS_H
#define LMP_CENSUS_H

#include "event.h"
#include "model/decisive_terms.h"

#include <array>

namespace LAMMPS_NS {

class Census {
 public:
  enum Total {
    BREAKUPS,
    MERGES,
    BORN,
    DEFERRED,
    E_LOST,
    E_BORN,
    TESTS,
    SHARE_ST,
    SHARE_CC,
    SHARE_MF,
    BREAKUPS_BY_ST,
    BREAKUPS_BY_CC,
    WHOLE_BY_ST,
    WHOLE_BY_MF,
    MERGES_BY_ST,
    MERGES_BY_MF,
    DRAG_FORCE,
    CONTACT_FORCE,
    WEIGHT,
    FED,
    LEFT,
    CLUSTERS_FED,
    CLUSTERS_LEFT,
    E_CONTACTS,
    E_SPIN,
    NTOTALS
  };
  using Totals = std::array<double, NTOTALS>;
  static constexpr int TOTALS_OF_0_1 = CLUSTERS_LEFT + 1;    // that restart files of version 0.1 hold

  const Totals &totals() const { return sum; }
  void resume(const Totals &before) { sum = before; }    // of a restart file
  void add(Total what, double amount = 1.0) { sum[what] += amount; }

  // a cluster of n particles and diameter d that was tested for breakup and does not break
  void whole(const ClusterDEM::SizeRule &, const ClusterDEM::PowerParts &, int n, double d);
  // an event that happens
  void happened(const Event &);
  // the parent of a breakup of its own
  void broke(const ClusterDEM::SizeRule &, const ClusterDEM::PowerParts &, int n, double d);
  // the two that merge to n particles
  void merged(const ClusterDEM::SizeRule &, const ClusterDEM::PowerParts &, const ClusterDEM::PowerParts &, int n);

  // a cluster of n particles that another command lets in, or takes out
  void came(int n);
  void left(int n);
  void left_elsewhere(int n);    // it has only gone to another rank, which tells

 private:
  Totals sum = {};
};

}    // namespace LAMMPS_NS
#endif
