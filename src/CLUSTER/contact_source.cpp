/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "contact_source.h"

#include "near_pairs.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void ContactSource::find_contacts()
{
  touching.clear();
  for (Pair *pair : pairs) {
    if (take_noted(pair)) continue;
    const double *radius = atom->radius;
    const bool bonds = can_bond(pair);
    each_near_pair(atom, pair, [&](int i, int j, int slot, const Vec3 &d) {
      const double reach = radius[i] + radius[j], rsq = dot(d, d);
      if (rsq < reach * reach || (bonds && bonded(pair, i, j, slot, rsq)))
        touching.push_back({i, j, pair, false, {}});
    });
  }
}

/* ---------------------------------------------------------------------- */

ContactSource::Load ContactSource::load(const Contact &c) const
{
  if (c.noted) return c.noted_load;
  const Vec3 force = contact_force(c);
  return {dot(force, to_vec3(atom->v[c.i]) - to_vec3(atom->v[c.j])), norm(force)};
}
