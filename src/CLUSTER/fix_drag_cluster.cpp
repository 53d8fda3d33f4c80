/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_drag_cluster.h"

#include "fix_cluster_breakmerge.h"
#include "gas_frames.h"
#include "model/drag_table.h"
#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "memory.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

static constexpr int COLUMNS = 8;    // gas velocity, drag force, Re, tau
static constexpr int BLOCK = 64;     // clusters whose drag is computed together

/* ---------------------------------------------------------------------- */

FixDragCluster::FixDragCluster(LAMMPS *lmp, int narg, char **arg) :
    EngineFix(lmp, narg, arg), law(std::make_unique<TranCongDrag>(0.8, 1.1)), velocity_atom(nullptr),
    nmax_velocity(0), profile_axis(-1), fluctuation(NO_FLUCTUATION), amplitude{0.0, 0.0, 0.0}, cells{1, 1, 1},
    period(0.0), seed(0), period_now(0), inverse_length{0.0, 0.0, 0.0}, draw(nullptr),
    acts_along{true, true, true}, unshielded(0.0), particle_d(0.0), particle_mass(0.0), particle_given(false),
    exponential(false), refresh(1), held_dt(0.0), handed_over(false), peratom_rows(0), shortest_tau(INFINITY),
    totals{}, totals_all{}, totals_current(false)
{
  dynamic_group_allow = 1;
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  static int extensive[] = {1, 1, 1, 1, 0};
  extvector = -1;
  extlist = extensive;
  peratom_flag = 1;
  size_peratom_cols = COLUMNS;
  peratom_freq = 1;
  time_depend = 1;    // the fluctuation depends on the elapsed time

  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} requires atom style sphere or cluster: clusters have a diameter and a mass", style);

  StyleArguments args(lmp, narg, arg, 3);
  gas.rho = args.positive("rho_g", "mass/volume");
  gas.nu = args.positive("nu_g", "length^2/time");

  bool table = true;
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "velocity") parse_velocity(args);
    else if (keyword == "profile") parse_profile(args);
    else if (keyword == "field") parse_field(args);
    else if (keyword == "fluctuation") parse_fluctuation(args);
    else if (keyword == "law") parse_law(args);
    else if (keyword == "plane") parse_plane(args);
    else if (keyword == "unshielded") unshielded = args.within(keyword, 0.0, 1.0);
    else if (keyword == "particle") {
      particle_d = args.positive("particle d_p", "length");
      const double rho_p = args.positive("particle rho_p", "mass/volume");
      particle_mass = ClusterGeometry{particle_d, rho_p}.particle_mass();
      particle_given = true;
    } else if (keyword == "integrator") exponential = args.choice(keyword, {"explicit", "exponential"}) == 1;
    else if (keyword == "table") table = args.yes(keyword);
    else if (keyword == "refresh") refresh = args.integer("refresh", 1);
    else args.unknown_keyword();
  }

  if (field) {
    if (fluctuation == NO_FLUCTUATION) field->leave_out(GasFile::FLUCTUATION);
    field->tell();
  }
  if (table) law = std::make_unique<DragTable>(std::move(law));

  if (fluctuation == OWN) {
    if (!atom->tag_enable) error->all(FLERR, "Fix {} fluctuation own requires atom IDs", style);
    restart_peratom = 1;
    create_attribute = 1;
    maxexchange = 1;
    FixDragCluster::grow_arrays(atom->nmax);
    for (int i = 0; i < atom->nlocal; i++) draw[i] = 0;
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
  }

  peratom_rows = MAX(1, atom->nmax);
  memory->create(array_atom, peratom_rows, COLUMNS, "drag/cluster:array_atom");
  memset(&array_atom[0][0], 0, sizeof(double) * COLUMNS * peratom_rows);
}

/* ---------------------------------------------------------------------- */

FixDragCluster::~FixDragCluster()
{
  if (draw) {
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
  }
  memory->destroy(draw);
  memory->destroy(velocity_atom);
  memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- */

int FixDragCluster::setmask()
{
  return POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::init()
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} {} requires atom style sphere or cluster", style, id);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix {} {} does not support run_style respa: use run_style verlet", style, id);
  if (domain->triclinic) error->all(FLERR, "Fix {} {} does not support triclinic boxes", style, id);

  for (auto &component : velocity) {
    if (component.variable.empty()) continue;
    component.index = input->variable->find(component.variable.data());
    if (component.index < 0)
      error->all(FLERR, "Variable {} for fix {} {} does not exist", component.variable, style, id);
    component.per_atom = input->variable->atomstyle(component.index);
    if (!component.per_atom && !input->variable->equalstyle(component.index))
      error->all(FLERR, "Variable {} for fix {} {} must be equal-style or atom-style", component.variable, style,
                 id);
  }
  if (unshielded > 0.0) find_primary_particle();
  if (field) field->init();
}

/* ----------------------------------------------------------------------
   unshielded drag counts primary particles: given by keyword, or as the size law has them
------------------------------------------------------------------------- */

void FixDragCluster::find_primary_particle()
{
  if (particle_given) return;
  const auto fixes = modify->get_fix_by_style("^cluster/breakmerge");
  if (fixes.empty())
    error->all(FLERR,
               "Fix {} {}: unshielded {} needs the primary particle: define a fix cluster/breakmerge "
               "or give the keyword particle d_p rho_p",
               style, id, unshielded);
  const auto *sizes = dynamic_cast<FixClusterBreakMerge *>(fixes[0]);
  if (!sizes->one_kind())
    error->all(FLERR,
               "Fix {} {}: unshielded {} knows one kind of primary particle only, but fix {} {} has several: use "
               "unshielded 0 or give the keyword particle d_p rho_p",
               style, id, unshielded, sizes->style, sizes->id);
  const auto &geometry = sizes->cluster_geometry(1);
  particle_d = geometry.d_p;
  particle_mass = geometry.particle_mass();
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::setup(int vflag)
{
  post_force(vflag);
}

/* ----------------------------------------------------------------------
   evaluate variables and the period of the fluctuation, once per step
------------------------------------------------------------------------- */

void FixDragCluster::prepare()
{
  const double t = update->atime + (update->ntimestep - update->atimestep) * update->dt;
  period_now = period_index(t, period);
  if (field) field->prepare(t);
  if (static_cast<int>(cache.size()) < atom->nmax) cache.resize(atom->nmax);
  for (int k = 0; k < 3; k++) inverse_length[k] = 1.0 / domain->prd[k];

  if (!any_variable()) return;

  modify->clearstep_compute();
  for (int k = 0; k < 3; k++) {
    auto &component = velocity[k];
    if (component.index < 0) continue;
    if (component.per_atom) {
      if (atom->nmax > nmax_velocity) {
        nmax_velocity = atom->nmax;
        memory->destroy(velocity_atom);
        memory->create(velocity_atom, nmax_velocity, 3, "drag/cluster:velocity_atom");
      }
      input->variable->compute_atom(component.index, igroup, &velocity_atom[0][k], 3, 0);
    } else {
      component.value = input->variable->compute_equal(component.index);
      if (!std::isfinite(component.value))
        error->all(FLERR, "Fix {} {}: variable {} gave {} at step {}: the gas velocity must be finite", style, id,
                   component.variable, component.value, update->ntimestep);
    }
  }
  modify->addstep_compute(update->ntimestep + 1);
}

bool FixDragCluster::any_variable() const
{
  for (const auto &component : velocity)
    if (component.index >= 0) return true;
  return false;
}

/* ----------------------------------------------------------------------
   gas that owned cluster i sees; its velocity: mean + profile + field + fluctuation
------------------------------------------------------------------------- */

LocalGas FixDragCluster::gas_at(int i)
{
  LocalGas here = {{}, gas};
  Vec3 &u = here.u;
  for (int k = 0; k < 3; k++) u[k] = velocity[k].per_atom ? velocity_atom[i][k] : velocity[k].value;
  if (profile_axis >= 0) {
    double s = atom->x[i][profile_axis];
    if (domain->periodicity[profile_axis]) {    // a cluster may be just outside until it is wrapped
      if (s < domain->boxlo[profile_axis]) s += domain->prd[profile_axis];
      else if (s >= domain->boxhi[profile_axis]) s -= domain->prd[profile_axis];
    }
    u = u + profile.at(s);
  }
  Vec3 a = amplitude;
  if (field) {
    double values[GasFrames::MOST_VALUES];
    field->at(atom->x[i], values);
    u = u + to_vec3(values);
    if (field->has(GasFile::DENSITY)) here.gas.rho = values[field->first(GasFile::DENSITY)];
    if (field->has(GasFile::VISCOSITY)) here.gas.nu = values[field->first(GasFile::VISCOSITY)];
    if (field->has(GasFile::FLUCTUATION))
      for (int k = 0; k < 3; k++) a[k] *= values[field->first(GasFile::FLUCTUATION) + k];
  }
  if (fluctuation != NO_FLUCTUATION) {
    const Vec3 &unit = unit_fluctuation(i);
    for (int k = 0; k < 3; k++) u[k] += a[k] * unit[k];
  }
  return here;
}

bool FixDragCluster::uniform_properties() const
{
  return !field || !(field->has(GasFile::DENSITY) || field->has(GasFile::VISCOSITY));
}

/* ----------------------------------------------------------------------
   random numbers from -1 to 1, of the cell or of the cluster
------------------------------------------------------------------------- */

const Vec3 &FixDragCluster::unit_fluctuation(int i)
{
  CachedFluctuation &cached = cache[i];
  int64_t a, b = 0;
  if (fluctuation == PER_CELL) {
    const double *x = atom->x[i];
    a = 0;
    for (int k = 2; k >= 0; k--)
      a = a * cells[k] + cell_index((x[k] - domain->boxlo[k]) * inverse_length[k], cells[k]);
  } else {
    a = atom->tag[i];
    b = draw[i];
  }
  if (cached.a != a || cached.b != b || cached.period != period_now) {
    cached.a = a;
    cached.b = b;
    cached.period = period_now;
    cached.unit = fluctuation == PER_CELL ? cell_fluctuation(seed, a, period_now)
                                          : own_fluctuation(seed, a, b, period_now);
  }
  return cached.unit;
}

/* ----------------------------------------------------------------------
   drag on owned cluster i is this coefficient times its slip
------------------------------------------------------------------------- */

double FixDragCluster::cluster_coefficient(int i, const Gas &here, double slip_speed) const
{
  const double n = unshielded > 0.0 ? atom->rmass[i] / particle_mass : 0.0;
  return cluster_drag_coefficient(*law, here, 2.0 * atom->radius[i], particle_d, n, unshielded, slip_speed);
}

Vec3 FixDragCluster::in_plane(const Vec3 &force) const
{
  return {acts_along[0] ? force[0] : 0.0, acts_along[1] ? force[1] : 0.0, acts_along[2] ? force[2] : 0.0};
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::post_force(int)
{
  if (handed_over) {
    handed_over = false;
    return;
  }
  for (double &t : totals) t = 0.0;
  totals_current = false;
  const bool finite = due() ? add_drag_anew() : add_held_drag();
  if (!finite)
    error->one(FLERR,
               "Fix {} {}: the drag force is not finite at step {}: check the gas velocity and "
               "the time step",
               style, id, update->ntimestep);
  if (!exponential && update->dt > 2.0 * shortest_tau)
    error->one(FLERR,
               "Fix {} {}: the time step {} is above twice the relaxation time {} of a cluster at step {}, "
               "where explicit drag grows without bounds: use a shorter time step or 'integrator exponential'",
               style, id, update->dt, shortest_tau, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

bool FixDragCluster::add_drag_anew()
{
  const int nlocal = atom->nlocal;
  prepare();
  if (peratom_rows < atom->nmax) {
    peratom_rows = atom->nmax;
    memory->destroy(array_atom);
    memory->create(array_atom, peratom_rows, COLUMNS, "drag/cluster:array_atom");
  }
  if (refresh > 1 && static_cast<int>(held_b.size()) < atom->nmax) {
    held_u.resize(3 * static_cast<std::size_t>(atom->nmax));
    held_b.resize(atom->nmax);
  }
  held_dt = update->dt;
  shortest_tau = INFINITY;
  bool finite = true;
  for (int first = 0; first < nlocal; first += BLOCK)
    finite = add_drag(first, MIN(first + BLOCK, nlocal)) && finite;
  return finite;
}

/* ----------------------------------------------------------------------
   Drag on the clusters of one block, in short loops of one thing each: roots and quotients of
   neighbouring clusters then overlap in the processor instead of waiting for each other.
   False where a force is not finite.
------------------------------------------------------------------------- */

bool FixDragCluster::add_drag(int first, int last)
{
  double **v = atom->v;
  double **f = atom->f;
  const double *radius = atom->radius;
  const double *rmass = atom->rmass;
  const int *mask = atom->mask;
  const double dt = update->dt;
  const int n = last - first;
  LocalGas seen[BLOCK];
  Vec3 slip[BLOCK];
  double speed[BLOCK], b[BLOCK];

  // outside of the group the gas goes along: no slip, no force
  for (int m = 0; m < n; m++) {
    const int i = first + m;
    seen[m] = mask[i] & groupbit ? gas_at(i) : LocalGas{to_vec3(v[i]), gas};
  }
  for (int m = 0; m < n; m++) {
    slip[m] = in_plane(seen[m].u - to_vec3(v[first + m]));
    speed[m] = norm(slip[m]);
  }
  for (int m = 0; m < n; m++) b[m] = cluster_coefficient(first + m, seen[m].gas, speed[m]);

  double sum[4] = {0.0, 0.0, 0.0, 0.0};
  for (int m = 0; m < n; m++) {
    const int i = first + m;
    double *row = array_atom[i];
    if (!(mask[i] & groupbit)) {
      memset(row, 0, sizeof(double) * COLUMNS);
      if (refresh > 1) hold(i, {0.0, 0.0, 0.0}, 0.0);
      continue;
    }
    const double tau = b[m] > 0.0 ? rmass[i] / b[m] : INFINITY;
    shortest_tau = MIN(shortest_tau, tau);
    const double coefficient = exponential ? b[m] * exponential_factor(dt / tau) : b[m];
    const Vec3 drag = coefficient * slip[m];
    if (refresh > 1) hold(i, seen[m].u, coefficient);
    for (int k = 0; k < 3; k++) {
      f[i][k] += drag[k];
      sum[k] += drag[k];
      row[k] = seen[m].u[k];
      row[3 + k] = drag[k];
    }
    sum[3] += dot(drag, to_vec3(v[i]));
    row[6] = reynolds(speed[m], 2.0 * radius[i], seen[m].gas);
    row[7] = tau;
  }
  for (int k = 0; k < 4; k++) totals[k] += sum[k];
  return std::isfinite(sum[0] + sum[1] + sum[2]);
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::redraw(int i)
{
  if (fluctuation == OWN) draw[i]++;
}

/* ----------------------------------------------------------------------
   draw number per cluster: migrates, is written to restart files (own fluctuation only)
------------------------------------------------------------------------- */

void FixDragCluster::grow_arrays(int nmax)
{
  memory->grow(draw, nmax, "drag/cluster:draw");
}

void FixDragCluster::copy_arrays(int i, int j, int)
{
  draw[j] = draw[i];
}

void FixDragCluster::set_arrays(int i)
{
  draw[i] = 0;
}

int FixDragCluster::pack_exchange(int i, double *buf)
{
  buf[0] = ubuf(draw[i]).d;
  return 1;
}

int FixDragCluster::unpack_exchange(int nlocal, double *buf)
{
  draw[nlocal] = static_cast<int>(ubuf(buf[0]).i);
  return 1;
}

int FixDragCluster::pack_restart(int i, double *buf)
{
  buf[0] = 2;
  buf[1] = ubuf(draw[i]).d;
  return 2;
}

void FixDragCluster::unpack_restart(int nlocal, int nth)
{
  double **extra = atom->extra;
  int m = 0;
  for (int i = 0; i < nth; i++) m += static_cast<int>(extra[nlocal][m]);
  draw[nlocal] = static_cast<int>(ubuf(extra[nlocal][m + 1]).i);
}

int FixDragCluster::size_restart(int)
{
  return 2;
}

int FixDragCluster::maxsize_restart()
{
  return 2;
}

/* ----------------------------------------------------------------------
   total drag force on the group, its power, most memory that the gas field takes on a rank
------------------------------------------------------------------------- */

double FixDragCluster::compute_vector(int n)
{
  if (n == 4) {
    const double mine = field ? field->bytes() : 0.0;
    double most = 0.0;
    MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
    return most;
  }
  if (!totals_current) {
    MPI_Allreduce(totals, totals_all, 4, MPI_DOUBLE, MPI_SUM, world);
    totals_current = true;
  }
  return totals_all[n];
}

/* ---------------------------------------------------------------------- */

double FixDragCluster::memory_usage()
{
  return (double) peratom_rows * COLUMNS * sizeof(double) + (double) cache.size() * sizeof(CachedFluctuation) +
      (double) (held_u.size() + held_b.size()) * sizeof(double) + (double) nmax_velocity * 3 * sizeof(double) +
      (draw ? (double) atom->nmax * sizeof(int) : 0.0) + (field ? field->bytes() : 0.0);
}
