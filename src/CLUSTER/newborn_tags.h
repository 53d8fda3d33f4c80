/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Atom IDs of new clusters: above every ID ever used, in the order of keys that say nothing of the ranks, such as the IDs of
// parents, then of the pieces. A rank's memory and bytes go with its births, its messages with the logarithm of the ranks.

#ifndef LMP_NEWBORN_TAGS_H
#define LMP_NEWBORN_TAGS_H

#include "engine.h"

#include <cstdint>
#include <vector>

namespace LAMMPS_NS {

class NewbornTags : protected EnginePointers {
 public:
  struct Birth {
    std::uint64_t key;    // two births have two keys
    int newborns;
    tagint first = 0;    // out: the newborns are numbered from here
    int index = 0, from = 0, at = 0;
  };

  NewbornTags(class LAMMPS *lmp) : EnginePointers(lmp), highest(0) {}

  void raise(tagint tag) { highest = tag > highest ? tag : highest; }
  void start_over(tagint tag) { highest = tag; }    // where all IDs were given anew
  tagint highest_used() const { return highest; }

  // collective: sets first of every birth, and raises the highest ID used. Keys lie below `range`, somewhat evenly:
  // the ranks share the sorting by them.
  void assign(std::vector<Birth> &births, double range);

 private:
  tagint highest;
  void number(std::vector<Birth> &part) const;
  void check(bigint n) const;
};

}    // namespace LAMMPS_NS
#endif
