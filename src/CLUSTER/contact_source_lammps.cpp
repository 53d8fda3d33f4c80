/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Contacts of LAMMPS' granular pair styles and of pair gran/cluster, which notes them while it computes; of others
// single() is asked.

#include "contact_source.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "pair_gran_cluster.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void ContactSource::find(const std::string &fix, int groupbit, double largest_diameter)
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

void ContactSource::check_cutoff(const std::string &fix, int groupbit, double largest_diameter) const
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

void ContactSource::expect_contacts(bigint step)
{
  for (Pair *pair : pairs)
    if (auto *ours = dynamic_cast<PairGranCluster *>(pair)) ours->record_contacts(step - 1);
}

/* ---------------------------------------------------------------------- */

bool ContactSource::take_noted(Pair *pair)
{
  const auto *ours = dynamic_cast<const PairGranCluster *>(pair);
  if (!ours || !ours->contacts_recorded(update->ntimestep - 1)) return false;
  for (const auto &c : ours->contacts()) touching.push_back({c.i, c.j, pair, true, {c.power, c.force}});
  return true;
}

/* ----------------------------------------------------------------------
   single() of the sub-style gives the normal force over distance; svector[0..2] is the tangential force
------------------------------------------------------------------------- */

Vec3 ContactSource::contact_force(const Contact &c) const
{
  const Vec3 dx = to_vec3(atom->x[c.i]) - to_vec3(atom->x[c.j]);
  double normal = 0.0;
  c.pair->single(c.i, c.j, atom->type[c.i], atom->type[c.j], dot(dx, dx), 1.0, 1.0, normal);
  return normal * dx + to_vec3(c.pair->svector);
}

/* ----------------------------------------------------------------------
   the same force law at equal velocities, where it does not damp
------------------------------------------------------------------------- */

double ContactSource::stiffness(const Contact &c) const
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
