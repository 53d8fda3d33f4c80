/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "contact_survey.h"

#include "atom.h"
#include "comm.h"
#include "contact_source.h"
#include "model/contact_law.h"
#include "near_pairs.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

ContactSurvey::Found ContactSurvey::look(double limit, double near, double drift) const
{
  double **v = atom->v;
  const double *radius = atom->radius;
  Found s;
  for (const Pair *style : contacts.pair_styles())
    each_near_pair(atom, style, [&](int i, int j, int, const Vec3 &d) {
      const double reach = radius[i] + radius[j] + near;
      if (dot(d, d) > reach * reach) return;
      const Approach pair = approach(radius[i], radius[j], d, to_vec3(v[i]) - to_vec3(v[j]), drift);
      if (pair.depth() > s.my_deepest) {
        s.my_deepest = pair.depth();
        s.deepest_pair = {i, j, pair};
      }
      const double time = pair.time_to(limit);
      if (time < s.my_soonest) {
        s.my_soonest = time;
        s.soonest_pair = {i, j, pair};
      }
    });
  const double mine[2] = {s.my_deepest, -s.my_soonest};
  double all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  s.deepest = all[0];
  s.soonest = -all[1];
  return s;
}

/* ----------------------------------------------------------------------
   of several ranks that hold the pair the first tells it
------------------------------------------------------------------------- */

ContactSurvey::Meeting ContactSurvey::tell(const Near &pair, bool mine) const
{
  int holder = mine && pair.i >= 0 ? comm->me : comm->nprocs, first;
  MPI_Allreduce(&holder, &first, 1, MPI_INT, MPI_MIN, world);
  Meeting m = {};
  if (first == comm->me) {
    const double mi = atom->rmass[pair.i], mj = atom->rmass[pair.j];
    m = {{(double) atom->tag[pair.i], (double) atom->tag[pair.j]}, pair.approach, reduced_mass(mi, mj)};
  }
  if (first < comm->nprocs) MPI_Bcast(&m, sizeof(m), MPI_BYTE, first, world);
  return m;
}
