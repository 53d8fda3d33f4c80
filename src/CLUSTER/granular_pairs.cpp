/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "granular_pairs.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "model/step_control.h"
#include "neigh_list.h"
#include "pair_gran_cluster.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void GranularPairs::find(const std::string &fix, int groupbit, double largest_diameter)
{
  pairs.clear();
  for (const char *word : {"^granular", "^gran/"})
    for (int nsub = 1;; nsub++) {
      Pair *pair = force->pair_match(word, 0, nsub);
      bool known = pair == nullptr;
      for (const Pair *p : pairs) known = known || p == pair;
      if (known) break;
      pairs.push_back(pair);
    }
  if (pairs.empty())
    error->all(FLERR, "{} needs a granular pair style (granular or gran/*), but the pair style is {}", fix,
               force->pair_style ? force->pair_style : "none");
  for (const Pair *pair : pairs)
    if (!pair->single_enable) error->all(FLERR, "{} needs a pair style with a single() function", fix);

  if (comm->ghost_velocity == 0)
    error->all(FLERR, "{} needs the velocities of ghost clusters: use comm_modify vel yes", fix);

  check_cutoff(fix, groupbit, largest_diameter);
}

/* ----------------------------------------------------------------------
   A pair style takes its cutoff from the largest radius there is at set-up; clusters that merge to
   a larger one would overlap without a force, and without a word.
------------------------------------------------------------------------- */

void GranularPairs::check_cutoff(const std::string &fix, int groupbit, double largest_diameter) const
{
  std::vector<int> present(atom->ntypes + 1, 0), anywhere(atom->ntypes + 1, 0);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) present[atom->type[i]] = 1;
  MPI_Allreduce(present.data(), anywhere.data(), atom->ntypes + 1, MPI_INT, MPI_MAX, world);
  for (int a = 1; a <= atom->ntypes; a++)
    for (int b = a; b <= atom->ntypes; b++) {
      if (!anywhere[a] || !anywhere[b]) continue;
      const double cutoff = std::sqrt(force->pair->cutsq[a][b]);
      if (cutoff < largest_diameter * (1.0 - 1.0e-12))
        error->all(
            FLERR,
            "{}: the pair cutoff of types {} and {} is {}, below the largest cluster diameter {} "
            "that the limits allow, so that merged clusters would overlap without a force: add "
            "'cutoff {}' to pair_coeff of pair style granular or to pair_style gran/cluster, or for other gran/* "
            "use pair_style hybrid/overlay with 'zero {}'",
            fix, a, b, cutoff, largest_diameter, largest_diameter * 1.0001, largest_diameter * 1.0001);
    }
}

/* ---------------------------------------------------------------------- */

void GranularPairs::expect_contacts(bigint step)
{
  for (Pair *pair : pairs)
    if (auto *ours = dynamic_cast<PairGranCluster *>(pair)) ours->record_contacts(step - 1);
}

/* ---------------------------------------------------------------------- */

void GranularPairs::find_contacts()
{
  touching.clear();
  for (Pair *pair : pairs) {
    const auto *ours = dynamic_cast<const PairGranCluster *>(pair);
    if (ours && ours->contacts_recorded(update->ntimestep - 1))
      for (const auto &c : ours->contacts()) touching.push_back({c.i, c.j, pair, true, {c.power, c.force}});
    else walk(pair);
  }
}

/* ---------------------------------------------------------------------- */

void GranularPairs::walk(Pair *pair)
{
  double **x = atom->x;
  const double *radius = atom->radius;
  const NeighList *list = pair->list;    // NOLINT(clang-analyzer-core.NullDereference): of `pairs`, none is null
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int *jlist = list->firstneigh[i];
    const double xi = x[i][0], yi = x[i][1], zi = x[i][2], ri = radius[i];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = jlist[jj] & NEIGHMASK;
      const double dx = xi - x[j][0], dy = yi - x[j][1], dz = zi - x[j][2];
      const double reach = ri + radius[j];
      if (dx * dx + dy * dy + dz * dz < reach * reach) touching.push_back({i, j, pair, false, {}});
    }
  }
}

/* ---------------------------------------------------------------------- */

GranularPairs::Load GranularPairs::load(const Contact &c) const
{
  if (c.noted) return c.noted_load;
  const Vec3 force = contact_force(c);
  return {dot(force, to_vec3(atom->v[c.i]) - to_vec3(atom->v[c.j])), norm(force)};
}

/* ---------------------------------------------------------------------- */

GranularPairs::Survey GranularPairs::survey(double limit, double near, double drift) const
{
  double **x = atom->x, **v = atom->v;
  const double *radius = atom->radius;
  Survey s;
  for (const Pair *pair : pairs) {
    const NeighList *list = pair->list;
    for (int ii = 0; ii < list->inum; ii++) {
      const int i = list->ilist[ii];
      const int *jlist = list->firstneigh[i];
      for (int jj = 0; jj < list->numneigh[i]; jj++) {
        const int j = jlist[jj] & NEIGHMASK;
        const Vec3 d = to_vec3(x[i]) - to_vec3(x[j]);
        const double touching = radius[i] + radius[j], reach = touching + near;
        if (dot(d, d) > reach * reach) continue;
        const Vec3 w = to_vec3(v[i]) - to_vec3(v[j]);
        const Passage way = passage(d - drift * w, w, drift);
        const double smaller = 2.0 * MIN(radius[i], radius[j]);
        const double overlap = touching - way.closest;
        if (overlap / smaller > s.my_deepest.value) s.my_deepest = {overlap / smaller, i, j, overlap, way.closing};
        const double time = time_to_overlap(overlap, limit * smaller, way.closing);
        if (time < s.my_soonest.value) s.my_soonest = {time, i, j, overlap, way.closing};
      }
    }
  }
  const double mine[2] = {s.my_deepest.value, -s.my_soonest.value};
  double all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  s.deepest = all[0];
  s.soonest = -all[1];
  return s;
}

/* ---------------------------------------------------------------------- */

GranularPairs::Meeting GranularPairs::meeting(const Survey::Mine &mine, double extreme) const
{
  int holder = mine.i >= 0 && mine.value == extreme ? comm->me : comm->nprocs, first;
  MPI_Allreduce(&holder, &first, 1, MPI_INT, MPI_MIN, world);
  Meeting m = {};
  if (first == comm->me) {
    const double mi = atom->rmass[mine.i], mj = atom->rmass[mine.j];
    m = {{(double) atom->tag[mine.i], (double) atom->tag[mine.j]},
         mine.overlap,
         2.0 * MIN(atom->radius[mine.i], atom->radius[mine.j]),
         mine.closing,
         mi * mj / (mi + mj)};
  }
  if (first < comm->nprocs) MPI_Bcast(&m, sizeof(m), MPI_BYTE, first, world);
  return m;
}

/* ----------------------------------------------------------------------
   single() of the sub-style gives the normal force over distance; svector[0..2] is the tangential force
------------------------------------------------------------------------- */

Vec3 GranularPairs::contact_force(const Contact &c) const
{
  const Vec3 dx = to_vec3(atom->x[c.i]) - to_vec3(atom->x[c.j]);
  double normal = 0.0;
  c.pair->single(c.i, c.j, atom->type[c.i], atom->type[c.j], dot(dx, dx), 1.0, 1.0, normal);
  return normal * dx + to_vec3(c.pair->svector);
}

/* ----------------------------------------------------------------------
   the same force law at equal velocities, where it does not damp
------------------------------------------------------------------------- */

double GranularPairs::stiffness(const Contact &c) const
{
  if (const auto *ours = dynamic_cast<const PairGranCluster *>(c.pair)) return ours->contact_law().k_n;
  double *vi = atom->v[c.i];
  double kept[3];
  memcpy(kept, vi, sizeof(kept));
  memcpy(vi, atom->v[c.j], sizeof(kept));
  const Vec3 dx = to_vec3(atom->x[c.i]) - to_vec3(atom->x[c.j]);
  double normal = 0.0;
  // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): a contact has its pair style
  c.pair->single(c.i, c.j, atom->type[c.i], atom->type[c.j], dot(dx, dx), 1.0, 1.0, normal);
  memcpy(vi, kept, sizeof(kept));
  const double r = ClusterDEM::norm(dx);
  const double overlap = atom->radius[c.i] + atom->radius[c.j] - r;
  return overlap > 0.0 ? std::fabs(normal) * r / overlap : 0.0;
}
