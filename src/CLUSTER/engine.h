/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The fixes drag/cluster and cluster/breakmerge are one source for two engines. They speak to the engine in the
// words of LAMMPS; what LIGGGHTS says differently is translated in src/LIGGGHTS/engine_liggghts.h.

#ifndef LMP_CLUSTER_ENGINE_H
#define LMP_CLUSTER_ENGINE_H

#ifdef CLUSTER_FOR_LIGGGHTS    // set by the build
#include "engine_liggghts.h"
#else

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "model/rounded_up.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "pointers.h"
#include "region.h"
#include "sorted_dumps.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace LAMMPS_NS {

using EngineFix = Fix;
using EnginePointers = Pointers;

// one exchange of a fix's own values, `size` numbers per cluster (see fix_halo.h)
inline void forward_values(Comm *comm, Fix *fix, int size)
{
  comm->forward_comm(fix, size);
}
inline void reverse_values(Comm *comm, Fix *fix, int size)
{
  comm->reverse_comm(fix, size);
}
inline void reverse_lists_of_values(Comm *comm, Fix *fix)
{
  comm->reverse_comm_variable(fix);
}

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

inline std::vector<Fix *> all_fixes(LAMMPS *lmp)
{
  return lmp->modify->get_fix_list();
}
inline std::vector<Fix *> find_fixes(LAMMPS *lmp, const std::string &style)
{
  return lmp->modify->get_fix_by_style(style);
}

inline Fix *find_fix(LAMMPS *lmp, const std::string &id)
{
  return lmp->modify->get_fix_by_id(id);
}

// clusters that another fix still moves in its own way: none in LAMMPS
class MotionOfOthers {
 public:
  void find(LAMMPS *) {}
  bool holds(int, bigint) const { return false; }
};

// fixes whose values for an atom tell of its contacts, not of itself
inline std::vector<Fix *> fixes_that_remember_contacts(LAMMPS *lmp)
{
  std::vector<Fix *> found;
  for (const char *style : {"^NEIGH_HISTORY", "^wall/gran"})
    for (Fix *fix : find_fixes(lmp, style)) found.push_back(fix);
  return found;
}

// LAMMPS keeps mass and diameter alone
inline void set_density(Atom *, int, double) {}

// where regions are at this step
inline void prepare_regions(const std::vector<Region *> &regions)
{
  for (Region *region : regions) region->prematch();
}
// why no sphere can be kept within a region; empty if it can
inline std::string region_without_sides(const Region *region)
{
  if (region->openflag && region->dynamic) return "has open faces and moves: no place can be told to be within";
  for (int k = 0; region->reglist && k < region->nregion; k++)
    if (region->reglist[k]->openflag || !region_without_sides(region->reglist[k]).empty())
      return "joins regions with open faces: no place can be told to be within";
  return "";
}

inline Region *region_of(Domain *domain, const std::string &id)
{
  return domain->get_region_by_id(id);
}

inline bool any_in_both(LAMMPS *lmp, int groupbit, int other)
{
  int mine = 0, any;
  for (int i = 0; i < lmp->atom->nlocal; i++)
    if ((lmp->atom->mask[i] & groupbit) && (lmp->atom->mask[i] & other)) mine = 1;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, lmp->world);
  return any;
}

// What there is in the scene that changes or binds clusters behind the back of their breakups and merges; empty if
// there is nothing.
inline std::string not_for_clusters(LAMMPS *lmp, int groupbit)
{
  if (lmp->domain->triclinic) return "triclinic boxes";
  if (lmp->atom->molecular != Atom::ATOMIC) return "molecules: use an atom style without bonds";
  if (lmp->kokkos) return "KOKKOS: run without its suffix and its -k switch";
  for (const auto &fix : lmp->modify->get_fix_list()) {
    const std::string name = fmt::format("fix {} {}", fix->style, fix->id);
    if (fix->rigid_flag && any_in_both(lmp, groupbit, fix->groupbit))
      return name + ": clusters are no rigid bodies";
    if (fix->diam_flag) return name + ", which changes diameters";
  }
  return "";
}

// how far beyond its part of the box a rank sees every atom of this type and radius, by the cutoffs that the pair style and the user ask
// for; ghosts of which the cutoff is, for a message; the command that makes ranks see further
struct ReducedReach : Comm {    // comm_modify reduce/multi, which nobody is told
  static bool asked(const Comm *comm) { return comm->*(&ReducedReach::multi_reduce); }
};
inline double ghost_reach(LAMMPS *lmp, int type, double /*radius*/)
{
  const Comm *comm = lmp->comm;
  const Pair *pair = lmp->force->pair;
  const double skin = lmp->neighbor->skin;
  if (comm->mode == Comm::SINGLE) return std::max(pair->cutforce + skin, comm->cutghostuser);
  double of_pairs = 0.0;
  for (int other = 1; other <= lmp->atom->ntypes; other++)
    of_pairs = std::max(of_pairs, std::sqrt(pair->cutsq[type][other]) + skin);
  if (comm->mode != Comm::MULTI) return 0.0;    // multi/old, which newer versions have no more: not looked at
  // collections are types, unless the user makes them otherwise: then any may hold this type
  const double *first = comm->cutusermulti, *last = first ? first + comm->ncollections_cutoff : first;
  if (lmp->neighbor->custom_collection_flag || ReducedReach::asked(comm))
    return first == last ? 0.0 : std::max(0.0, *std::min_element(first, last));
  return type <= last - first ? std::max(of_pairs, first[type - 1]) : of_pairs;
}
inline std::string ghosts_of_a_type(LAMMPS *lmp, int type)
{
  return lmp->comm->mode == Comm::SINGLE ? "" : fmt::format(" of type {}", type);
}
inline std::string ask_for_ghosts(LAMMPS *lmp, double reach)
{
  const int mode = lmp->comm->mode;
  if (mode == Comm::MULTI) return fmt::format("comm_modify cutoff/multi * {}", ClusterDEM::rounded_up(reach));
  return fmt::format("comm_modify{} cutoff {}", mode == Comm::SINGLE ? "" : " mode single",
                     ClusterDEM::rounded_up(reach));
}

}    // namespace LAMMPS_NS

#endif
#endif
