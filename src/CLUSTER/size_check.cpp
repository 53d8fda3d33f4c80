/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "size_check.h"

#include "fix_drag_cluster.h"

#include "atom.h"
#include "error.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

namespace {
enum CellValues { MASS, MASS_SPEED, DRAG_POWER, NVALUES };    // the speed with its sign for the reading up vector
}

/* ---------------------------------------------------------------------- */

SizeCheck::SizeCheck(LAMMPS *lmp, const BreakMergeSettings &all, const ClusterColumns &c, int group) :
    EnginePointers(lmp), settings(all.size), kinds(all.kinds), columns(c), groupbit(group), drag(nullptr)
{
  for (int k = 0; k < kinds.count(); k++)
    rules.push_back({0.0, all.event.hysteresis, kinds.kind(k), kinds.limits});
  u_mf.resize(kinds.count());
}

/* ---------------------------------------------------------------------- */

void SizeCheck::init(const std::string &me)
{
  drag = nullptr;
  if (!settings.drag_id.empty()) {
    Fix *fix = find_fix(lmp, settings.drag_id);
    if (!fix) error->all(FLERR, "{}: drag fix ID {} does not exist", me, settings.drag_id);
    drag = dynamic_cast<FixDragCluster *>(fix);
    if (!drag)
      error->all(FLERR, "{}: drag fix {} is of style {}, not drag/cluster", me, settings.drag_id, fix->style);
  }
  for (int k = 0; k < kinds.count(); k++) {
    const ClusterGeometry &particles = kinds.kind(k);
    u_mf[k] = settings.umf_from_wen_yu() && drag ? umf_in(drag->prescribed_gas().properties(), particles)
                                                 : settings.umf;
    rules[k].k = settings.k_from_emms
        ? k_emms(particles.d_p, settings.k, u_mf[k], settings.eps_mf, settings.gravity)
        : settings.k;
    if (!(rules[k].k > 0.0))
      error->all(FLERR,
                 "{}: K emms {} gives K = {}: U_p must be above {} (so that U_p/(1 - 0.9997) exceeds "
                 "the minimum fluidization)",
                 me, settings.k, rules[k].k, u_mf[k] * 3.0e-4);
  }
}

void SizeCheck::make_cells(Fix *owner)
{
  if (settings.cells_given) averages = std::make_unique<CellAverages>(lmp, owner, settings.cells, NVALUES);
}

double SizeCheck::drag_force(int i) const
{
  return norm(drag->force_on(i));
}

/* ----------------------------------------------------------------------
   minimum fluidization velocity after Wen & Yu: of each cluster's own gas where density or viscosity vary
------------------------------------------------------------------------- */

double SizeCheck::umf_in(const Gas &gas, const ClusterGeometry &particles) const
{
  return umf_wen_yu(particles.d_p, particles.rho_p, gas, settings.gravity);
}

bool SizeCheck::local_umf() const
{
  return settings.term_mf && settings.umf_from_wen_yu() && drag && !drag->prescribed_gas().uniform_properties();
}

/* ---------------------------------------------------------------------- */

void SizeCheck::measure(const ContactSums &contacts)
{
  if (settings.term_st || local_umf()) drag->prescribed_gas().prepare();
  if (averages) average_cells();
  n_stable.resize(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) {
      n_stable[i] = 0;
      continue;
    }
    const int kind = kinds.of_type(atom->type[i]);
    const PowerParts power(settings.term_st ? gas_power(i, kinds.kind(kind)) : 0.0,
                           settings.looks_at_power() ? n_cc(contacts.power(i), atom->rmass[i], settings.ncc_factor)
                                                     : 0.0,
                           settings.term_mf ? fluidization_power(i, kind) : 0.0);
    const StableSize size = rules[kind].stable(power.e_in());
    n_stable[i] = size.n;
    double *row = (*columns.shown)[i];
    row[ClusterColumns::L] = size.l;
    row[ClusterColumns::ST] = power.part[PowerParts::ST];
    row[ClusterColumns::CC] = power.part[PowerParts::CC];
    row[ClusterColumns::MF] = -power.part[PowerParts::MF];
  }
}

/* ---------------------------------------------------------------------- */

void SizeCheck::average_cells()
{
  averages->clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    const Vec3 v = to_vec3(atom->v[i]);
    averages->add(x, MASS, atom->rmass[i]);
    const double speed = v[settings.gravity_axis];
    averages->add(x, MASS_SPEED, atom->rmass[i] * (settings.up == UpReading::VECTOR ? speed : std::fabs(speed)));
    if (settings.term_st && settings.nst == NstReading::CELL) {
      const ClusterDrag &law = drag->drag_on_clusters();
      const LocalGas here = drag->prescribed_gas().at(i);
      const Vec3 slip = law.in_plane(here.u - v);
      averages->add(x, DRAG_POWER, dot(law.coefficient(i, here.gas, norm(slip)) * slip, here.u));
    }
  }
  averages->sum();
}

/* ---------------------------------------------------------------------- */

double SizeCheck::gas_power(int i, const ClusterGeometry &particles)
{
  if (settings.nst == NstReading::CELL) {
    const double *x = atom->x[i];
    return averages->total(x, DRAG_POWER) / averages->total(x, MASS);
  }
  const ClusterDrag &law = drag->drag_on_clusters();
  const LocalGas here = drag->prescribed_gas().at(i);
  const Vec3 slip = law.in_plane(here.u - to_vec3(atom->v[i]));
  const double speed = norm(slip);
  if (settings.nst == NstReading::PARTICLE)
    return n_st(law.particle_coefficient(i, here.gas, particles.d_p, speed) * slip, here.u,
                particles.particle_mass());
  return n_st(law.coefficient(i, here.gas, speed) * slip, here.u, atom->rmass[i]);
}

double SizeCheck::fluidization_power(int i, int kind)
{
  const ClusterGeometry &particles = kinds.kind(kind);
  double speed = std::fabs(atom->v[i][settings.gravity_axis]);
  if (settings.up != UpReading::OWN) {
    const double *x = atom->x[i];
    const double mass = averages->total(x, MASS);
    speed = std::fabs(mean_speed(averages->total(x, MASS_SPEED), mass));
    if (settings.up == UpReading::SUPERFICIAL)
      speed = superficial_speed(speed, mass, particles.rho_p, averages->cell_volume());
  }
  const double here = local_umf() ? umf_in(drag->prescribed_gas().at(i).gas, particles) : u_mf[kind];
  return n_smf(settings.nsmf, here, speed, settings.eps_mf, settings.gravity);
}
