/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Dumps sorted by ID. A dump that finds IDs 1 to N at the start of a run keeps a shortcut for the whole run: an atom's ID is its
// place. Events leave gaps in the IDs, and once the number of atoms is again that of the start the engine would write past the
// end of its memory. The engine knows this of fix gcmc, by name; for our fix the shortcut is taken back here.

#ifndef LMP_SORTED_DUMPS_H
#define LMP_SORTED_DUMPS_H

#include "dump.h"
#include "lammps.h"
#include "output.h"

namespace LAMMPS_NS {

// dumps let those that inherit from them look
struct SortedDump : Dump {
  static void sort_in_earnest(Dump *dump) { dump->*(&SortedDump::reorderflag) = 0; }
};

inline void sort_dumps_in_earnest(LAMMPS *lmp)
{
  for (int k = 0; k < lmp->output->ndump; k++) SortedDump::sort_in_earnest(lmp->output->dump[k]);
}

}    // namespace LAMMPS_NS
#endif
