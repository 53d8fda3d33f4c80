/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "largest_diameters.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

bool LargestDiameters::find()
{
  const int n = atom->ntypes + 1;
  std::vector<double> largest(n, 0.0), largest_anywhere(n, 0.0);
  std::vector<int> count(2 * n, 0), sum(2 * n, 0);
  for (int i = 0; i < atom->nlocal; i++) {
    const int type = atom->type[i];
    const bool other = !(atom->mask[i] & groupbit);
    int &seen = count[other ? n + type : type];
    seen = std::min(2, seen + 1);
    if (other) largest[type] = std::max(largest[type], 2.0 * atom->radius[i]);
  }
  MPI_Allreduce(largest.data(), largest_anywhere.data(), n, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(count.data(), sum.data(), 2 * n, MPI_INT, MPI_SUM, world);
  for (int &c : sum) c = std::min(2, c);

  const std::vector<int> clusters_now(sum.begin(), sum.begin() + n), others_now(sum.begin() + n, sum.end());
  const bool changed = clusters != clusters_now || others != others_now || diameters != largest_anywhere;
  clusters = clusters_now;
  others = others_now;
  diameters = largest_anywhere;
  return changed;
}

/* ---------------------------------------------------------------------- */

bool LargestDiameters::group_is_empty() const
{
  return std::all_of(clusters.begin(), clusters.end(), [](int count) { return count == 0; });
}

double LargestDiameters::of(int type) const
{
  const double allowed = in_group(type) ? kinds.geometry(type).diameter(kinds.limits.hi) : 0.0;
  return std::max(allowed, diameters[type]);
}

// clusters of a type may become more
bool LargestDiameters::may_meet(int a, int b) const
{
  if (!(of(a) > 0.0) || !(of(b) > 0.0)) return false;
  return a != b || in_group(a) || others[a] > 1;
}
