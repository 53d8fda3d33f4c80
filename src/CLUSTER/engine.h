/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The fixes drag/cluster and cluster/breakmerge are one source for two engines. They speak to the engine in the
// words of LAMMPS; what LIGGGHTS says differently is translated in src/LIGGGHTS/engine_liggghts.h.

#ifndef LMP_CLUSTER_ENGINE_H
#define LMP_CLUSTER_ENGINE_H

#if __has_include("engine_liggghts.h")
#include "engine_liggghts.h"
#else

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "pointers.h"
#include "utils.h"

#include <string>

namespace LAMMPS_NS {

using EngineFix = Fix;
using EnginePointers = Pointers;

// events find clusters by their IDs; a hash, because IDs only ever grow
inline void use_hash_map(Atom *atom, const Domain *domain)
{
  if (atom->map_style != Atom::MAP_NONE) return;
  atom->map_user = Atom::MAP_HASH;
  atom->map_style = Atom::MAP_HASH;
  if (domain->box_exist) {
    atom->nghost = 0;
    atom->map_init();
    atom->map_set();
  }
}

// how far beyond its part of the box a rank sees every cluster, where the pair style and the user ask for these cutoffs,
// and the command that makes it see further
inline double ghost_reach(double pair_cutoff, double user_cutoff, double /*skin*/)
{
  return pair_cutoff > user_cutoff ? pair_cutoff : user_cutoff;
}
inline std::string ask_for_ghosts(double reach, double /*skin*/)
{
  return fmt::format("comm_modify cutoff {}", reach);
}

}    // namespace LAMMPS_NS

#endif
#endif
