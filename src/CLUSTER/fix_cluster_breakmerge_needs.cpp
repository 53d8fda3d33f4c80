/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the scene needs: which terms of E_in* decide its events, which forces act on its clusters.

#include "fix_cluster_breakmerge.h"

#include "fix_drag_cluster.h"

#include "atom.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

PowerParts FixClusterBreakMerge::power_parts(int i) const
{
  const double *row = array_atom[i];
  return {row[3], row[4], row[5]};
}

/* ----------------------------------------------------------------------
   forces as they last acted, at a check: nothing is evaluated for this alone
------------------------------------------------------------------------- */

void FixClusterBreakMerge::note_forces()
{
  double drag_force = 0.0, mass = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (drag) drag_force += norm(drag->force_on(i));
    mass += atom->rmass[i];
  }
  totals[DRAG_FORCE] += drag_force;
  totals[CONTACT_FORCE] += contact_force;
  totals[WEIGHT] += mass * gravity;
}

/* ----------------------------------------------------------------------
   a cluster that was tested and does not break
------------------------------------------------------------------------- */

void FixClusterBreakMerge::note_whole(int i)
{
  const PowerParts power = power_parts(i);
  if (kind(i).rule.whole_only_by(PowerParts::ST, power, count[i], array_atom[i][1])) totals[WHOLE_BY_ST]++;
  if (kind(i).rule.whole_only_by(PowerParts::MF, power, count[i], array_atom[i][1])) totals[WHOLE_BY_MF]++;
}

/* ----------------------------------------------------------------------
   a breakup that happens; i still is the parent
------------------------------------------------------------------------- */

void FixClusterBreakMerge::note_breakup(int i)
{
  const PowerParts power = power_parts(i);
  totals[SHARE_ST] += power.share(PowerParts::ST);
  totals[SHARE_CC] += power.share(PowerParts::CC);
  totals[SHARE_MF] += power.share(PowerParts::MF);
  if (kind(i).rule.breaks_only_by(PowerParts::ST, power, count[i], array_atom[i][1])) totals[BREAKUPS_BY_ST]++;
  if (kind(i).rule.breaks_only_by(PowerParts::CC, power, count[i], array_atom[i][1])) totals[BREAKUPS_BY_CC]++;
}

/* ----------------------------------------------------------------------
   terms without which owned cluster i would refuse to be part of one of n particles
------------------------------------------------------------------------- */

int FixClusterBreakMerge::needed_to_merge(int i, int n) const
{
  const PowerParts power = power_parts(i);
  return (kind(i).rule.merges_only_by(PowerParts::ST, power, n) ? NEEDS_ST : 0) |
      (kind(i).rule.merges_only_by(PowerParts::MF, power, n) ? NEEDS_MF : 0);
}
