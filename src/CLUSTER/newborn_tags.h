/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Atom IDs of newborn clusters: above every ID ever used, in the order of the parents' IDs, then of
// the pieces, whatever the number of ranks. Memory and messages go with the births of one rank.

#ifndef LMP_NEWBORN_TAGS_H
#define LMP_NEWBORN_TAGS_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class NewbornTags : protected Pointers {
 public:
  struct Birth {
    tagint parent;
    int newborns;
    tagint first;    // out: the newborns are numbered from here
    int proc, index;
  };

  NewbornTags(class LAMMPS *lmp) : Pointers(lmp), highest(0) {}

  void raise(tagint tag) { highest = tag > highest ? tag : highest; }
  tagint highest_used() const { return highest; }

  // the highest ID used before; the next n belong to the caller, on all ranks alike
  tagint take(bigint n);

  // collective: sets first of every birth, and raises the highest ID used
  void assign(std::vector<Birth> &births);

 private:
  tagint highest;
  void check(bigint n) const;
  static int number_bucket(int, char *, int &, int *&, char *&, void *);
};

}    // namespace LAMMPS_NS
#endif
