/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What contacts add up to for each cluster at a check: the power of their forces, their number, who touches. Nothing is
// summed or sent that nobody asks for.

#ifndef LMP_CONTACT_SUMS_H
#define LMP_CONTACT_SUMS_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "contact_source.h"
#include "halo.h"

#include <vector>

namespace LAMMPS_NS {

class ContactSums : protected EnginePointers {
 public:
  ContactSums(class LAMMPS *lmp, ContactSource &contacts, Halo &h, int group) :
      EnginePointers(lmp), pairs(contacts), halo(h), groupbit(group), total(0.0)
  {
  }

  void add_up(const BreakMergeSettings &);

  double power(int i) const { return sums[i].power; }    // sum over j of F_ij . dU_ij
  bool in_contact(int i) const { return sums[i].number > 0; }
  double magnitude() const { return total; }    // of all contacts of my clusters, magnitudes

  // has any of these ended? They become the contacts of now.
  bool ended_since(std::vector<tagint> &before, int i);

 private:
  ContactSource &pairs;
  Halo &halo;
  int groupbit;
  struct Sum {
    double power;
    int number;
  };
  std::vector<Sum> sums;
  std::vector<std::vector<tagint>> touching;
  double total;
};

}    // namespace LAMMPS_NS
#endif
