/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Registers the styles when LAMMPS loads the plugin. Empty in a static build, which registers them itself.

#ifdef CLUSTER_PLUGIN

#include "lammpsplugin.h"

#include "fix_cluster_breakmerge.h"
#include "fix_drag_cluster.h"

#include "error.h"
#include "lammps.h"
#include "version.h"

#include <cstring>

using namespace LAMMPS_NS;

template <class FixClass> static void *create_fix(void *lmp, int narg, char **arg)
{
  return new FixClass((LAMMPS *) lmp, narg, arg);
}

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  auto lammps = (LAMMPS *) lmp;
  if (strcmp(lammps->version, LAMMPS_VERSION) != 0)
    lammps->error->all(FLERR, "The CLUSTER plugin was built for LAMMPS {} but is loaded into LAMMPS {}: "
                       "rebuild it against the source of this LAMMPS", LAMMPS_VERSION, lammps->version);

  auto register_style = (lammpsplugin_regfunc) regfunc;
  lammpsplugin_t plugin;
  plugin.version = LAMMPS_VERSION;
  plugin.style = "fix";
  plugin.author = "Cluster DEM developers";
  plugin.handle = handle;

  plugin.name = "drag/cluster";
  plugin.info = "gas drag on particle clusters";
  plugin.creator.v2 = (lammpsplugin_factory2 *) &create_fix<FixDragCluster>;
  register_style(&plugin, lmp);

  plugin.name = "cluster/breakmerge";
  plugin.info = "size, breakup and merging of particle clusters";
  plugin.creator.v2 = (lammpsplugin_factory2 *) &create_fix<FixClusterBreakMerge>;
  register_style(&plugin, lmp);
}

#endif
