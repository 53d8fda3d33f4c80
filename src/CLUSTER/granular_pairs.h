/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The granular pair style, or the granular sub-styles of a hybrid one: which clusters touch, and the
// contact force between two of them.

#ifndef LMP_GRANULAR_PAIRS_H
#define LMP_GRANULAR_PAIRS_H

#include "pointers.h"

#include "model/vector3.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Pair;

class GranularPairs : protected Pointers {
 public:
  struct Contact {
    int i, j;    // as they stand in the neighbor list: i is owned
    Pair *pair;
  };

  GranularPairs(class LAMMPS *lmp) : Pointers(lmp) {}

  // find the pair styles; stops with an error that names the fix if there is none, or if a pair of
  // clusters of the largest diameter could be missed
  void find(const std::string &fix, int groupbit, double largest_diameter);

  // collect all pairs of the half neighbor lists that overlap now
  void find_contacts();
  const std::vector<Contact> &contacts() const { return touching; }

  // force of j on i, at this instant
  ClusterDEM::Vec3 contact_force(const Contact &) const;

  // elastic normal force over overlap at this instant, damping left out
  double stiffness(const Contact &) const;

 private:
  std::vector<Pair *> pairs;
  std::vector<Contact> touching;
};

}    // namespace LAMMPS_NS
#endif
