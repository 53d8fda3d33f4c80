/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Spheres of a few events, binned over this rank's part of the box and its ghosts, so that the search
// for what lies near them costs one look-up per cluster. No more bins than clusters of this rank.

#ifndef LMP_LOCAL_BINS_H
#define LMP_LOCAL_BINS_H

#include "model/vector3.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

class LocalBins {
 public:
  // the region that all centres lie in (others are counted to its edge), the least side of a bin, and
  // the most bins there may be
  LocalBins(const ClusterDEM::Vec3 &lo, const ClusterDEM::Vec3 &hi, double side, int most) : lo_(lo)
  {
    double total;
    do {
      total = 1.0;
      for (int k = 0; k < 3; k++) {
        n_[k] = std::max(1, static_cast<int>(std::min((hi[k] - lo[k]) / side, 1.0e6)));
        inverse_[k] = n_[k] / (hi[k] - lo[k]);
        total *= n_[k];
      }
      side *= 1.5;
    } while (total > std::max(most, 1));
    head_.assign(static_cast<std::size_t>(total), -1);
  }

  void add(const ClusterDEM::Vec3 &x, double reach, int id)
  {
    over(x, reach, [&](int &head) {
      entries_.push_back({id, head});
      head = static_cast<int>(entries_.size()) - 1;
    });
  }

  // ids whose spheres may reach the point
  template <class Visit> void near(const double *x, Visit visit) const
  {
    const int bin = (index(2, x[2]) * n_[1] + index(1, x[1])) * n_[0] + index(0, x[0]);
    for (int e = head_[bin]; e >= 0; e = entries_[e].next) visit(entries_[e].id);
  }

  // ids whose spheres may reach the sphere, some more than once
  template <class Visit> void near(const ClusterDEM::Vec3 &x, double reach, Visit visit)
  {
    over(x, reach, [&](int &head) {
      for (int e = head; e >= 0; e = entries_[e].next) visit(entries_[e].id);
    });
  }

 private:
  struct Entry {
    int id, next;
  };
  ClusterDEM::Vec3 lo_, inverse_;
  int n_[3];
  std::vector<int> head_;
  std::vector<Entry> entries_;

  int index(int k, double x) const
  {
    const double share = (x - lo_[k]) * inverse_[k];
    if (!(share > 0.0)) return 0;
    return share >= n_[k] ? n_[k] - 1 : static_cast<int>(share);
  }

  template <class Action> void over(const ClusterDEM::Vec3 &x, double reach, Action action)
  {
    for (int c = index(2, x[2] - reach); c <= index(2, x[2] + reach); c++)
      for (int b = index(1, x[1] - reach); b <= index(1, x[1] + reach); b++)
        for (int a = index(0, x[0] - reach); a <= index(0, x[0] + reach); a++)
          action(head_[(c * n_[1] + b) * n_[0] + a]);
  }
};

}    // namespace LAMMPS_NS
#endif
