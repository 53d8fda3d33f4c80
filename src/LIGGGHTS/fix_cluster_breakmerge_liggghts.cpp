/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_cluster_breakmerge_liggghts.h"

#include "force.h"
#include "pair_gran.h"
#include "update.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixClusterBreakMergeLiggghts::FixClusterBreakMergeLiggghts(LAMMPS *lmp, int narg, char **arg) :
    FixClusterBreakMerge(lmp, narg, arg)
{
  rad_mass_vary_flag = 1;
}

/* ----------------------------------------------------------------------
   the pair style makes room for its contact forces when it is set up, before any fix is
------------------------------------------------------------------------- */

void FixClusterBreakMergeLiggghts::post_create()
{
  if (!settings.size.looks_at_power()) return;
  auto *pair = dynamic_cast<PairGran *>(force->pair_match("gran", 0));
  if (!pair) error->all(FLERR, "Fix {} {}: must be defined after a granular pair_style command", style, id);
  pair->do_store_contact_forces();
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMergeLiggghts::init()
{
  FixClusterBreakMerge::init();
  auto *pair = dynamic_cast<PairGran *>(force->pair_match("gran", 0));
  if (settings.size.looks_at_power() && !pair->fix_contact_forces())
    error->all(FLERR, "Fix {} {}: the pair_style command was given anew after this fix: define the fix after it",
               style, id);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMergeLiggghts::pre_exchange()
{
  FixClusterBreakMerge::pre_exchange();
  Fix::comm->maxexchange_fix = MAX(Fix::comm->maxexchange_fix, maxexchange);
}

/* ----------------------------------------------------------------------
   the largest radius that merging may lead to: pair style and neighbor lists make room for it
------------------------------------------------------------------------- */

double FixClusterBreakMergeLiggghts::max_rad(int type)
{
  return 0.5 * settings.kinds.geometry(type).diameter(settings.kinds.limits.hi);
}
