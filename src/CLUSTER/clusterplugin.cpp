/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Registers the styles when LAMMPS loads the plugin. Empty in a static build, which registers them itself.

#ifdef CLUSTER_PLUGIN

#include "lammpsplugin.h"

#include "atom_vec_cluster.h"
#include "fix_cluster_breakmerge.h"
#include "fix_cluster_timestep.h"
#include "fix_drag_cluster.h"
#include "fix_nve_cluster.h"
#include "pair_gran_cluster.h"
#include "replicate_cluster.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "utils.h"
#include "version.h"

#include <cstring>

using namespace LAMMPS_NS;

template <class FixClass> static void *create_fix(void *lmp, int narg, char **arg)
{
  return new FixClass((LAMMPS *) lmp, narg, arg);
}

static Pair *create_pair(LAMMPS *lmp)
{
  return new PairGranCluster(lmp);
}

static Command *create_replicate(LAMMPS *lmp)
{
  return new ReplicateCluster(lmp);
}

static AtomVec *create_atom_vec(LAMMPS *lmp)
{
  return new AtomVecCluster(lmp);
}

// for those who look into the file: strings, nm, dlsym
extern "C" const char clusterdem_version[] = CLUSTER_VERSION;

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  auto lammps = (LAMMPS *) lmp;
  if (strcmp(lammps->version, LAMMPS_VERSION) != 0)
    lammps->error->all(FLERR,
                       "The CLUSTER plugin was built for LAMMPS {} but is loaded into LAMMPS {}: "
                       "rebuild it against the source of this LAMMPS",
                       LAMMPS_VERSION, lammps->version);

  if (lammps->comm->me == 0) utils::logmesg(lammps, "Cluster DEM {} for LAMMPS\n", clusterdem_version);

  auto register_style = (lammpsplugin_regfunc) regfunc;
  lammpsplugin_t plugin;
  plugin.version = LAMMPS_VERSION;
  plugin.style = "fix";
  plugin.author = "Cluster DEM developers, version " CLUSTER_VERSION;
  plugin.handle = handle;

  const struct {
    const char *name, *info;
    lammpsplugin_factory2 *create;
  } fixes[] = {
      {"drag/cluster", "gas drag on particle clusters", &create_fix<FixDragCluster>},
      {"cluster/breakmerge", "size, breakup and merging of particle clusters", &create_fix<FixClusterBreakMerge>},
      {"cluster/timestep", "time step that rejects and halves", &create_fix<FixClusterTimestep>},
      {"nve/cluster", "motion of particle clusters, with gravity and held drag in one pass",
       &create_fix<FixNVECluster>},
  };
  for (const auto &fix : fixes) {
    plugin.name = fix.name;
    plugin.info = fix.info;
    plugin.creator.v2 = fix.create;
    register_style(&plugin, lmp);
  }

  plugin.style = "pair";
  plugin.name = "gran/cluster";
  plugin.info = "contact of particle clusters";
  plugin.creator.v1 = (lammpsplugin_factory1 *) &create_pair;
  register_style(&plugin, lmp);

  plugin.style = "command";
  plugin.name = "replicate/cluster";
  plugin.info = "copies of a box of particle clusters";
  plugin.creator.v1 = (lammpsplugin_factory1 *) &create_replicate;
  register_style(&plugin, lmp);

  // The plugin interface knows no atom styles, but their table is open. An atom style outlives the unloading
  // of plugins when LAMMPS is cleared: the library is linked to stay in memory.
  (*lammps->atom->avec_map)["cluster"] = &create_atom_vec;
}

#endif
