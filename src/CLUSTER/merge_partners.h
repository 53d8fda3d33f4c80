/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Who merges with whom: of its contacts that move like it and fit together with it, each cluster chooses the one that moves
// most alike, of equal ones the lowest ID. A pair merges if each is the choice of the other; the lower ID leads.

#ifndef LMP_MERGE_PARTNERS_H
#define LMP_MERGE_PARTNERS_H

#include "crowd.h"
#include "halo.h"
#include "plan_rules.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {

class MergePartners {
 public:
  MergePartners(const Crowd &c, const PlanRules &r, Halo &h) : crowd(c), rules(r), halo(h) {}

  using Stiffness = std::function<double(std::size_t)>;    // of the contact of this number

  // Collective. `taken`: clusters that are part of another event, owned and ghosts.
  void choose(const std::vector<Touch> &, const Stiffness &, const std::vector<char> &taken);

  // the partner of an owned cluster, owned or ghost; -1: none
  int partner(int i) const;
  double stiffness(int i) const { return suitors[i].stiffness; }    // of the contact between them

 private:
  const Crowd &crowd;
  const PlanRules &rules;
  Halo &halo;
  struct Suitor {
    double slip = 0.0;    // |dV| / min |V|
    double stiffness = 0.0;
    ClusterID id = 0;    // 0: none
    bool better_than(const Suitor &other) const
    {
      return other.id == 0 || slip < other.slip || (slip == other.slip && id < other.id);
    }
  };
  std::vector<Suitor> suitors;

  bool may_merge(int i, int j) const;
};

}    // namespace LAMMPS_NS
#endif
