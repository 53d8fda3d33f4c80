/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "normal_law.h"

#include "gran_sub_mod_normal.h"
#include "granular_model.h"
#include "model/contact_law.h"
#include "model/quadrature.h"
#include "pair_gran_cluster.h"
#include "pair_gran_hertz_history.h"
#include "pair_granular.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// the gran/* styles tell nobody their stiffness, but let those that inherit from them look
struct ClassicSpring : PairGranHookeHistory {
  static double stiffness(const PairGranHookeHistory &pair) { return pair.*(&ClassicSpring::kn); }
};

/* ---------------------------------------------------------------------- */

NormalLaw::NormalLaw(const Pair *pair, int type_i, int type_j, double radius_i, double radius_j) :
    cluster(dynamic_cast<const PairGranCluster *>(pair)),
    classic(cluster ? nullptr : dynamic_cast<const PairGranHookeHistory *>(pair)), r_i(radius_i), r_j(radius_j)
{
  if (const auto *granular = dynamic_cast<const PairGranular *>(pair))
    model = granular->models_list[granular->types_indices[type_i][type_j]];
}

bool NormalLaw::knows(const Pair *pair)
{
  const auto *granular = dynamic_cast<const PairGranular *>(pair);
  if (!granular) return dynamic_cast<const PairGranHookeHistory *>(pair);
  return std::all_of(granular->models_list, granular->models_list + granular->nmodels,
                     [](const Granular_NS::GranularModel *law) { return law->normal_model->size_history == 0; });
}

/* ---------------------------------------------------------------------- */

double NormalLaw::bond_length() const
{
  return model && model->beyond_contact ? model->pulloff_distance(r_i, r_j) : 0.0;
}

/* ----------------------------------------------------------------------
   pair granular sets all of this anew for every pair that it looks at
------------------------------------------------------------------------- */

void NormalLaw::set_geometry(double overlap) const
{
  model->radi = r_i;
  model->radj = r_j;
  model->radsum = r_i + r_j;
  model->Reff = reduced_radius(r_i, r_j);
  model->delta = overlap;
  model->dR = overlap * model->Reff;
  model->r = model->radsum - overlap;
  model->rsq = model->r * model->r;
  model->rinv = 1.0 / model->r;
  model->contact_radius = model->normal_model->calculate_contact_radius();
}

double NormalLaw::contact_radius(double overlap) const
{
  set_geometry(overlap);
  return model->contact_radius;
}

double NormalLaw::model_force(double overlap) const
{
  set_geometry(overlap);
  return model->normal_model->calculate_forces();
}

/* ---------------------------------------------------------------------- */

double NormalLaw::energy(double overlap) const
{
  const double begin = -bond_length();
  if (!(overlap > begin)) return 0.0;
  if (cluster) return cluster->contact_law().normal_energy(overlap);
  if (model) return integral_from_edge([this](double x) { return model_force(x); }, begin, overlap);
  const double k = ClassicSpring::stiffness(*classic);
  return dynamic_cast<const PairGranHertzHistory *>(classic) ? hertz_energy(k, reduced_radius(r_i, r_j), overlap)
                                                             : linear_energy(k, overlap);
}
