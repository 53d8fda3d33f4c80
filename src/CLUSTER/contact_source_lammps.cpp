/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Contacts of LAMMPS' granular pair styles and of pair gran/cluster, which notes them while it computes; of others
// single() is asked.

#include "contact_source.h"

#include "atom.h"
#include "comm.h"
#include "contact_memory.h"
#include "error.h"
#include "force.h"
#include "largest_diameters.h"
#include "normal_law.h"
#include "pair_gran_cluster.h"
#include "pair_hybrid.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// pair hybrid tells those that inherit from it which sub-styles act between two types
struct HybridMap : PairHybrid {
  static bool acts(const PairHybrid &hybrid, const Pair *sub, int a, int b)
  {
    const int *chosen = (hybrid.*(&HybridMap::map))[a][b], n = (hybrid.*(&HybridMap::nmap))[a][b];
    return std::any_of(chosen, chosen + n, [&](int k) { return (hybrid.*(&HybridMap::styles))[k] == sub; });
  }
};

static bool acts(const Pair *whole, const Pair *sub, int type_i, int type_j)
{
  const auto *hybrid = dynamic_cast<const PairHybrid *>(whole);
  return !hybrid || HybridMap::acts(*hybrid, sub, type_i, type_j);
}

/* ---------------------------------------------------------------------- */

void ContactSource::find(const std::string &fix, bool)
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
    if (!NormalLaw::knows(pair))
      error->all(
          FLERR,
          "{} knows the contact laws of the pair styles granular (but normal mdr, which remembers plastic "
          "deformation), gran/cluster, gran/hooke, gran/hooke/history and gran/hertz/history, not those of pair "
          "style {}",
          fix, force->pair_style);

  if (comm->ghost_velocity == 0)
    error->all(FLERR, "{} needs the velocities of ghost clusters: use comm_modify vel yes", fix);
}

/* ----------------------------------------------------------------------
   A pair style takes its cutoff from the largest radius there is at set-up, or from the user. Clusters that merge to a
   larger one, and bodies larger than all clusters, would overlap without a force, and without a word.
------------------------------------------------------------------------- */

std::string ContactSource::short_cutoff(const std::string &fix, const LargestDiameters &largest) const
{
  double longest = 0.0;
  std::string fault;
  for (int a = 1; a <= atom->ntypes; a++)
    for (int b = a; b <= atom->ntypes; b++) {
      if (!largest.may_meet(a, b)) continue;
      const double d_a = largest.of(a), d_b = largest.of(b), cutoff = std::sqrt(force->pair->cutsq[a][b]);
      double bond = 0.0;
      bool touch =
          largest.in_group(a) && largest.in_group(b);    // others may have no contacts, if the user says so
      for (const Pair *pair : pairs)
        if (acts(force->pair, pair, a, b)) {
          touch = true;
          bond = std::max(bond, NormalLaw(pair, a, b, 0.5 * d_a, 0.5 * d_b).bond_length());
        }
      const double reach = 0.5 * (d_a + d_b) + bond;
      if (!touch || cutoff >= reach * (1.0 - 1.0e-12) || reach <= longest) continue;
      longest = reach;
      auto whose = [&](int type) {
        return fmt::format("{} {}", rounded_up(largest.of(type)),
                           largest.of(type) > largest.outside(type) ? "that the limits allow"
                                                                    : "outside of the group");
      };
      const std::string touching = d_a == d_b ? "the largest cluster diameter " + whose(a)
                                              : fmt::format("{}, where the largest touch, of diameters {} and {}",
                                                            rounded_up(0.5 * (d_a + d_b)), whose(a), whose(b));
      const std::string bonds =
          bond > 0.0 ? fmt::format(" and the {:.4g} beyond it to which cohesion holds two", bond) : "";
      fault = fmt::format(
          "{}: the pair cutoff of types {} and {} is {:.6g}, below {}{}, so that they would overlap without a "
          "force: "
          "add "
          "'cutoff {}' to pair_coeff of pair style granular or to pair_style gran/cluster, or for other gran/* "
          "use pair_style hybrid/overlay with 'zero {}'",
          fix, a, b, cutoff, touching, bonds, rounded_up(reach), rounded_up(reach));
    }
  return fault;
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

/* ---------------------------------------------------------------------- */

double ContactSource::stiffest(int groupbit, double diameter) const
{
  std::vector<int> present(atom->ntypes + 1, 0), anywhere(atom->ntypes + 1, 0);
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) present[atom->type[i]] = 1;
  MPI_Allreduce(present.data(), anywhere.data(), atom->ntypes + 1, MPI_INT, MPI_MAX, world);
  const double overlap = 0.01 * diameter;
  double most = 0.0;
  for (const Pair *pair : pairs)
    for (int a = 1; a <= atom->ntypes; a++)
      for (int b = a; b <= atom->ntypes; b++)
        if (anywhere[a] && anywhere[b] && acts(force->pair, pair, a, b))
          most = std::max(most, NormalLaw(pair, a, b, 0.5 * diameter, 0.5 * diameter).energy(overlap));
  return secant_stiffness(most, overlap);
}

/* ---------------------------------------------------------------------- */

bool ContactSource::can_bond(const Pair *pair) const
{
  return holds_beyond_touching(pair);
}

bool ContactSource::bonded(const Pair *pair, int i, int j, int slot, double rsq) const
{
  return is_bonded(atom, pair, i, j, slot, rsq);
}

/* ---------------------------------------------------------------------- */

// wherever the two stand in the lists
static bool bonded_now(const Atom *atom, const Pair *pair, int i, int j)
{
  const Vec3 d = to_vec3(atom->x[i]) - to_vec3(atom->x[j]);
  const int at_i = slot_of(atom, pair, i, j), at_j = slot_of(atom, pair, j, i);
  if (at_i >= 0) return is_bonded(atom, pair, i, j, at_i, dot(d, d));
  return at_j >= 0 && is_bonded(atom, pair, j, i, at_j, dot(d, d));
}

double ContactSource::energy(int i, int j, double radius_i, double distance) const
{
  const int *type = atom->type;
  const double overlap = radius_i + atom->radius[j] - distance;
  double sum = 0.0;
  for (const Pair *pair : pairs) {
    if (!acts(force->pair, pair, type[i], type[j])) continue;
    if (overlap > 0.0 || (can_bond(pair) && bonded_now(atom, pair, i, j)))
      sum += NormalLaw(pair, type[i], type[j], radius_i, atom->radius[j]).energy(overlap);
  }
  return sum;
}

/* ----------------------------------------------------------------------
   pair gran/cluster tells its whole energy
------------------------------------------------------------------------- */

double ContactSource::energy_now(const Contact &c) const
{
  const Vec3 d = to_vec3(atom->x[c.i]) - to_vec3(atom->x[c.j]);
  if (dynamic_cast<const PairGranCluster *>(c.pair)) {
    double unused;
    return c.pair->single(c.i, c.j, atom->type[c.i], atom->type[c.j], dot(d, d), 1.0, 1.0, unused);
  }
  const double *radius = atom->radius;
  const double overlap = radius[c.i] + radius[c.j] - norm(d);
  const NormalLaw law(c.pair, atom->type[c.i], atom->type[c.j], radius[c.i], radius[c.j]);
  const int slot = slot_of(atom, c.pair, c.i, c.j);
  return law.energy(overlap) + (slot < 0 ? 0.0 : tangential_energy(atom, c.pair, c.i, c.j, slot, overlap));
}
