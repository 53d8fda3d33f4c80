/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Who merges with whom: of its contacts that move like it and fit together with it, each cluster chooses the one that moves
// most alike, of equal ones the lowest ID. A pair merges if each is the choice of the other; the lower ID leads. Those who
// were not chosen choose again among the others, until nobody is left: the pairs are those that one gets by going through
// all contacts in the order of their slip.

#ifndef LMP_MERGE_PARTNERS_H
#define LMP_MERGE_PARTNERS_H

#include "crowd.h"
#include "halo.h"
#include "plan_rules.h"

#include <vector>

namespace LAMMPS_NS {

class MergePartners {
 public:
  MergePartners(const Crowd &c, const PlanRules &r, Halo &h) : crowd(c), rules(r), halo(h), rounds_(0) {}

  void choose(const std::vector<Touch> &);    // collective
  int partner(int i) const;                   // of an owned cluster, owned or ghost; -1: none
  int rounds() const { return rounds_; }

 private:
  const Crowd &crowd;
  const PlanRules &rules;
  Halo &halo;
  struct Suitor {
    double slip = 0.0;    // |dV| / min |V|
    ClusterID id = 0;     // 0: none
    bool better_than(const Suitor &other) const
    {
      return other.id == 0 || slip < other.slip || (slip == other.slip && id < other.id);
    }
  };
  struct Courtship {
    Touch touch;
    double slip;
  };
  std::vector<Suitor> suitors;
  std::vector<ClusterID> chosen;    // partners agreed on; 0: none
  int rounds_;

  bool may_merge(int i, int j, double slip) const;
  bool one_round(const std::vector<Courtship> &);
};

}    // namespace LAMMPS_NS
#endif
