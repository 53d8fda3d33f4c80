/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "merge_partners.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

bool MergePartners::may_merge(int i, int j) const
{
  if (crowd.kind[i] < 0 || crowd.kind[i] != crowd.kind[j] || crowd.id[i] == crowd.id[j]) return false;
  if (!(relative_slip(to_vec3(crowd.v[i]), to_vec3(crowd.v[j])) < rules.merge_tolerance)) return false;
  const int n_l = std::min(crowd.stable[i], crowd.stable[j]);
  if (fits_together(crowd.count[i], crowd.count[j], n_l)) return true;
  return rules.break_refused && plan_breakup(crowd.count[i] + crowd.count[j], n_l, rules.fewest()).is_event();
}

/* ---------------------------------------------------------------------- */

void MergePartners::choose(const std::vector<Touch> &touches, const Stiffness &stiffness_of,
                           const std::vector<char> &taken)
{
  suitors.assign(crowd.nall, Suitor());
  auto court = [&](int i, const Suitor &suitor) {
    if (suitor.better_than(suitors[i])) suitors[i] = suitor;
  };
  for (std::size_t k = 0; k < touches.size(); k++) {
    const int i = touches[k].i, j = touches[k].j;
    if (taken[i] || taken[j] || !may_merge(i, j)) continue;
    const double slip = relative_slip(to_vec3(crowd.v[i]), to_vec3(crowd.v[j]));
    const double stiffness = stiffness_of(k);
    court(i, {slip, stiffness, crowd.id[j]});
    if (!touches[k].listed_twice) court(j, {slip, stiffness, crowd.id[i]});
  }
  halo.reverse(suitors, [](Suitor &mine, const Suitor &theirs) {
    if (theirs.id && theirs.better_than(mine)) mine = theirs;
  });
  halo.forward(suitors);
}

int MergePartners::partner(int i) const
{
  if (suitors[i].id == 0) return -1;
  const int j = crowd.nearest_image(i, suitors[i].id);
  return j >= 0 && suitors[j].id == crowd.id[i] ? j : -1;
}
