/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "contact_memory.h"

#include "normal_law.h"

#include "atom.h"
#include "fix_neigh_history.h"
#include "gran_sub_mod_tangential.h"
#include "granular_model.h"
#include "model/contact_law.h"
#include "neigh_list.h"
#include "pair_gran_hertz_history.h"
#include "pair_granular.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// pair styles show their contact history to those that inherit from them
struct GranularMemory : PairGranular {
  static const FixNeighHistory *of(const PairGranular &pair) { return pair.*(&GranularMemory::fix_history); }
};
struct ClassicMemory : PairGranHookeHistory {
  static const FixNeighHistory *of(const PairGranHookeHistory &pair)
  {
    return pair.*(&ClassicMemory::fix_history);
  }
  static double stiffness(const PairGranHookeHistory &pair) { return pair.*(&ClassicMemory::kt); }
  static bool remembers(const PairGranHookeHistory &pair) { return pair.*(&ClassicMemory::history); }
};

/* ---------------------------------------------------------------------- */

bool LAMMPS_NS::holds_beyond_touching(const Pair *pair)
{
  return pair->beyond_contact;
}

/* ---------------------------------------------------------------------- */

bool LAMMPS_NS::is_bonded(const Atom *atom, const Pair *pair, int i, int j, int slot, double rsq)
{
  const auto *granular = dynamic_cast<const PairGranular *>(pair);
  const FixNeighHistory *memory = granular ? GranularMemory::of(*granular) : nullptr;
  if (!memory || !memory->firstflag || !memory->firstflag[i][slot]) return false;
  const double *radius = atom->radius;
  const NormalLaw law(pair, atom->type[i], atom->type[j], radius[i], radius[j]);
  const double reach = radius[i] + radius[j] + law.bond_length();
  return rsq < reach * reach;
}

/* ---------------------------------------------------------------------- */

int LAMMPS_NS::slot_of(const Atom *atom, const Pair *pair, int i, int j)
{
  if (i >= atom->nlocal) return -1;
  const NeighList *list = pair->list;
  for (int slot = 0; slot < list->numneigh[i]; slot++)
    if ((list->firstneigh[i][slot] & NEIGHMASK) == j) return slot;
  return -1;
}

/* ----------------------------------------------------------------------
   A spring of stiffness k, of Mindlin's laws times the contact radius, at displacement s or at force k s.
------------------------------------------------------------------------- */

double LAMMPS_NS::tangential_energy(const Atom *atom, const Pair *pair, int i, int j, int slot, double overlap)
{
  const double *radius = atom->radius;
  if (const auto *classic = dynamic_cast<const PairGranHookeHistory *>(pair)) {
    const FixNeighHistory *memory = ClassicMemory::of(*classic);
    if (!ClassicMemory::remembers(*classic) || !memory) return 0.0;
    double k = ClassicMemory::stiffness(*classic);
    if (dynamic_cast<const PairGranHertzHistory *>(pair))
      k *= std::sqrt(reduced_radius(radius[i], radius[j]) * overlap);
    return linear_energy(k, norm(to_vec3(memory->firstvalue[i] + 3 * slot)));
  }
  const auto *granular = dynamic_cast<const PairGranular *>(pair);
  const FixNeighHistory *memory = granular ? GranularMemory::of(*granular) : nullptr;
  if (!memory) return 0.0;
  const auto *model = granular->models_list[granular->types_indices[atom->type[i]][atom->type[j]]];
  const auto *tangential = model->tangential_model;
  if (!tangential->size_history) return 0.0;
  double k = tangential->get_k();
  if (tangential->contact_radius_flag)
    k *= NormalLaw(pair, atom->type[i], atom->type[j], radius[i], radius[j]).contact_radius(overlap);
  if (!(k > 0.0)) return 0.0;
  const double *values = memory->firstvalue[i] + granular->get_size_history() * slot + tangential->history_index;
  const double stored = norm(to_vec3(values));
  return linear_energy(k, tangential->name.find("force") != std::string::npos ? stored / k : stored);
}
