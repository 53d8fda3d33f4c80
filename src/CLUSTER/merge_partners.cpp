/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "merge_partners.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

bool MergePartners::may_merge(int i, int j, double slip) const
{
  if (crowd.kind[i] < 0 || crowd.kind[i] != crowd.kind[j] || crowd.id[i] == crowd.id[j]) return false;
  if (crowd.size[i].taken || crowd.size[j].taken || !(slip < rules.merge_tolerance)) return false;
  const int n_l = std::min(crowd.size[i].stable, crowd.size[j].stable);
  if (fits_together(crowd.size[i].count, crowd.size[j].count, n_l)) return true;
  return rules.break_refused &&
      plan_breakup(crowd.size[i].count + crowd.size[j].count, n_l, rules.fewest()).is_event();
}

/* ---------------------------------------------------------------------- */

void MergePartners::choose(const std::vector<Touch> &touches)
{
  std::vector<Courtship> possible;
  for (const Touch &touch : touches) {
    const double slip = relative_slip(to_vec3(crowd.v[touch.i]), to_vec3(crowd.v[touch.j]));
    if (may_merge(touch.i, touch.j, slip)) possible.push_back({touch, slip});
  }
  chosen.assign(crowd.nall, 0);
  if (!halo.anywhere(!possible.empty())) return;
  while (halo.anywhere(one_round(possible))) halo.forward(chosen);
}

/* ----------------------------------------------------------------------
   true if somebody here has chosen in vain
------------------------------------------------------------------------- */

bool MergePartners::one_round(const std::vector<Courtship> &possible)
{
  rounds_++;
  suitors.assign(crowd.nall, Suitor());
  auto court = [&](int i, const Suitor &suitor) {
    if (suitor.better_than(suitors[i])) suitors[i] = suitor;
  };
  for (const Courtship &c : possible) {
    const int i = c.touch.i, j = c.touch.j;
    if (chosen[i] || chosen[j]) continue;
    court(i, {c.slip, crowd.id[j]});
    court(j, {c.slip, crowd.id[i]});
  }
  halo.reverse(suitors, [](Suitor &mine, const Suitor &theirs) {
    if (theirs.id && theirs.better_than(mine)) mine = theirs;
  });
  halo.forward(suitors);

  bool in_vain = false;
  for (int i = 0; i < crowd.nlocal; i++) {
    if (suitors[i].id == 0) continue;
    const int j = crowd.nearest_image(i, suitors[i].id);
    if (j >= 0 && suitors[j].id == crowd.id[i]) chosen[i] = suitors[i].id;
    else in_vain = true;
  }
  return in_vain;
}

int MergePartners::partner(int i) const
{
  return chosen[i] ? crowd.nearest_image(i, chosen[i]) : -1;
}
