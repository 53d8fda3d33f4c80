/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// A stock LIGGGHTS with the fixes of this library, which is given by LD_PRELOAD: every new Modify, also that after a
// `clear` command, learns of them as it is built. Not needed where the fixes are compiled into LIGGGHTS itself.

#include "fix_cluster_breakmerge_liggghts.h"
#include "fix_drag_cluster.h"

#include "modify.h"

#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <map>
#include <string>

using namespace LAMMPS_NS;

namespace {

using FixMap = std::map<std::string, Fix *(*) (LAMMPS *, int, char **)>;
FixMap *&styles_of(Modify &);

// the table of styles is private; an explicit instantiation may name it all the same
template <FixMap *Modify::*table> struct Opener {
  friend FixMap *&styles_of(Modify &modify) { return modify.*table; }
};
template struct Opener<&Modify::fix_map>;

template <class FixClass> Fix *create(LAMMPS *lmp, int narg, char **arg)
{
  return new FixClass(lmp, narg, arg);
}

}    // namespace

// The constructor Modify::Modify(LAMMPS *) under its name in the library: that of LIGGGHTS is called first.
extern "C" __attribute__((visibility("default"))) void _ZN9LAMMPS_NS6ModifyC1EPNS_6LAMMPSE(Modify *self,
                                                                                           LAMMPS *lmp)
{
  using Constructor = void (*)(Modify *, LAMMPS *);
  static const auto real = reinterpret_cast<Constructor>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6ModifyC1EPNS_6LAMMPSE"));
  if (!real) {
    std::fputs("Cluster DEM: this executable is no LIGGGHTS 3.8 with a shared library\n", stderr);
    std::abort();
  }
  real(self, lmp);
  (*styles_of(*self))["drag/cluster"] = &create<FixDragCluster>;
  (*styles_of(*self))["cluster/breakmerge"] = &create<FixClusterBreakMergeLiggghts>;
}
