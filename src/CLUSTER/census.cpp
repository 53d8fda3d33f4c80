/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "census.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void Census::whole(const SizeRule &rule, const PowerParts &power, int n, double d)
{
  if (rule.whole_only_by(PowerParts::ST, power, n, d)) add(WHOLE_BY_ST);
  if (rule.whole_only_by(PowerParts::MF, power, n, d)) add(WHOLE_BY_MF);
}

/* ---------------------------------------------------------------------- */

void Census::happened(const Event &e)
{
  if (e.merges()) {
    add(MERGES);
    add(E_LOST, e.energy_lost);
    add(E_BORN, e.energy_born);
  }
  if (e.breaks()) {
    add(BREAKUPS);
    add(BORN, e.plan.pieces());
  }
}

void Census::broke(const SizeRule &rule, const PowerParts &power, int n, double d)
{
  add(SHARE_ST, power.share(PowerParts::ST));
  add(SHARE_CC, power.share(PowerParts::CC));
  add(SHARE_MF, power.share(PowerParts::MF));
  if (rule.breaks_only_by(PowerParts::ST, power, n, d)) add(BREAKUPS_BY_ST);
  if (rule.breaks_only_by(PowerParts::CC, power, n, d)) add(BREAKUPS_BY_CC);
}

/* ----------------------------------------------------------------------
   a term without which either of the two would refuse
------------------------------------------------------------------------- */

void Census::merged(const SizeRule &rule, const PowerParts &i, const PowerParts &j, int n)
{
  for (const auto &[term, total] : {std::pair{PowerParts::ST, MERGES_BY_ST}, {PowerParts::MF, MERGES_BY_MF}})
    if (rule.merges_only_by(term, i, n) || rule.merges_only_by(term, j, n)) add(total);
}

/* ---------------------------------------------------------------------- */

void Census::came(int n)
{
  add(FED, n);
  add(CLUSTERS_FED);
}

void Census::left(int n)
{
  add(LEFT, n);
  add(CLUSTERS_LEFT);
}

void Census::left_elsewhere(int n)
{
  add(LEFT, -n);
  add(CLUSTERS_LEFT, -1.0);
}
