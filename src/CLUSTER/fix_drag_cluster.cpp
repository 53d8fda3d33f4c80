/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_drag_cluster.h"

#include "requirements.h"
#include "style_arguments.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

static constexpr int BLOCK = 64;    // clusters whose drag is computed together
namespace {
enum Columns {
  GAS = 0,
  DRAG = 3,
  RE = 6,
  TAU = 7,
  VOIDAGE = 8
};    // of the per-atom array; the last with cells alone
}

/* ---------------------------------------------------------------------- */

FixDragCluster::FixDragCluster(LAMMPS *lmp, int narg, char **arg) :
    ClusterFix(lmp, narg, arg), gas(lmp), drag(lmp), held(lmp), exponential(false), shortest_tau(INFINITY),
    totals_all{}, totals_current(false)
{
  dynamic_group_allow = 1;
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  static int extensive[] = {1, 1, 1, 1, 0};
  extvector = -1;
  extlist = extensive;
  peratom_flag = 1;
  peratom_freq = 1;
  time_depend = 1;    // the fluctuation depends on the elapsed time

  StyleArguments args(lmp, narg, arg, 3);
  parse(args);
  if (gas.gusts().of_clusters() && !atom->tag_enable)
    error->all(FLERR, "Fix {} fluctuation own requires atom IDs", style);
  pergrid_flag = drag.voidage().any();    // fix balance tells whoever has a grid
  size_peratom_cols = drag.voidage().any() ? VOIDAGE + 1 : VOIDAGE;
  shown = &table.add_shown(size_peratom_cols);
  start_table();
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::parse(StyleArguments &args)
{
  gas.parse_properties(args);
  bool table_of_law = true;
  int refresh = 1;
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "velocity") gas.mean_velocity().parse(args);
    else if (keyword == "profile") gas.parse_profile(args, style);
    else if (keyword == "field") gas.parse_field(args, fmt::format("Fix {} {}", style, id));
    else if (keyword == "fluctuation") gas.gusts().parse(args);
    else if (keyword == "law") drag.parse_law(args);
    else if (keyword == "plane") drag.parse_plane(args);
    else if (keyword == "pressure") drag.parse_pressure(args);
    else if (keyword == "unshielded") drag.parse_unshielded(args);
    else if (keyword == "particle") drag.parse_particle(args);
    else if (keyword == "integrator") exponential = args.choice(keyword, {"explicit", "exponential"}) == 1;
    else if (keyword == "table") table_of_law = args.yes(keyword);
    else if (keyword == "refresh") refresh = args.integer("refresh", 1);
    else args.unknown_keyword();
  }
  const std::string me = fmt::format("Fix {} {}", style, id);
  drag.settle(table_of_law, table, me);
  gas.settle(table, igroup, me);
  held.hold_for(refresh, table);
  held.act_along(drag.in_plane({1.0, 1.0, 1.0}));
}

/* ---------------------------------------------------------------------- */

int FixDragCluster::setmask()
{
  return POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::init()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  require_clusters();
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "{} does not support run_style respa: use run_style verlet", me);
  if (domain->triclinic) error->all(FLERR, "{} does not support triclinic boxes", me);
  const std::string units = foreign_units(lmp, me);
  if (!units.empty()) error->all(FLERR, units);
  gas.init(me);
  drag.init(me, this);
}

void FixDragCluster::setup(int vflag)
{
  post_force(vflag);
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::post_force(int)
{
  if (held.handed_over()) return;
  const bool anew = held.due();
  if (anew) gas.evaluate_variables();
  else gas.mean_velocity().ask_for_next_step();    // the lists may be rebuilt at any step
  totals = anew ? add_drag_anew() : held.add();
  totals_current = false;
  if (!totals.finite())
    error->one(FLERR,
               "Fix {} {}: the drag force is not finite at step {}: check the gas velocity and "
               "the time step",
               style, id, update->ntimestep);
  if (!exponential && update->dt > 2.0 * shortest_tau)
    error->one(
        FLERR,
        "Fix {} {}: the time step {:.6g} is above twice the relaxation time {:.4g} of a cluster at step {}, "
        "where explicit drag grows without bounds: use a shorter time step or 'integrator exponential'",
        style, id, update->dt, shortest_tau, update->ntimestep);
}

/* ---------------------------------------------------------------------- */

DragTotals FixDragCluster::add_drag_anew()
{
  gas.prepare();
  drag.voidage().measure();
  held.start();
  shortest_tau = INFINITY;
  DragTotals sum;
  for (int first = 0; first < atom->nlocal; first += BLOCK) {
    const DragTotals block = add_drag(first, MIN(first + BLOCK, atom->nlocal));
    sum.force = sum.force + block.force;
    sum.power += block.power;
  }
  return sum;
}

/* ----------------------------------------------------------------------
   Drag on the clusters of one block, in short loops of one thing each: roots and quotients of
   neighbouring clusters then overlap in the processor instead of waiting for each other.
------------------------------------------------------------------------- */

DragTotals FixDragCluster::add_drag(int first, int last)
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
    seen[m] = mask[i] & groupbit ? gas.at(i) : LocalGas{to_vec3(v[i]), gas.properties()};
  }
  for (int m = 0; m < n; m++) {
    slip[m] = drag.in_plane(seen[m].u - to_vec3(v[first + m]));
    speed[m] = norm(slip[m]);
  }
  for (int m = 0; m < n; m++) b[m] = drag.coefficient(first + m, seen[m].gas, speed[m]);

  DragTotals sum;
  for (int m = 0; m < n; m++) {
    const int i = first + m;
    double *row = (*shown)[i];
    if (!(mask[i] & groupbit)) {
      std::fill(row, row + size_peratom_cols, 0.0);
      if (held.any()) held.hold(i, {0.0, 0.0, 0.0}, 0.0);
      continue;
    }
    const double tau = b[m] > 0.0 ? rmass[i] / b[m] : INFINITY;
    shortest_tau = MIN(shortest_tau, tau);
    const double coefficient = exponential ? b[m] * exponential_factor(dt / tau) : b[m];
    const Vec3 force = coefficient * slip[m];
    if (held.any()) held.hold(i, seen[m].u, coefficient);
    for (int k = 0; k < 3; k++) {
      f[i][k] += force[k];
      sum.force[k] += force[k];
      row[GAS + k] = seen[m].u[k];
      row[DRAG + k] = force[k];
    }
    sum.power += dot(force, to_vec3(v[i]));
    row[RE] = reynolds(speed[m], 2.0 * radius[i], seen[m].gas);
    row[TAU] = tau;
    if (size_peratom_cols > VOIDAGE) row[VOIDAGE] = drag.voidage().at(i);
  }
  return sum;
}

Vec3 FixDragCluster::force_on(int i) const
{
  return to_vec3((*shown)[i] + DRAG);
}

/* ---------------------------------------------------------------------- */

bool FixDragCluster::unpack_earlier(int i, const double *from, int n)
{
  return gas.gusts().resume(i, from, n);
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::reset_grid()
{
  if (drag.voidage().cells()) drag.voidage().cells()->reset();
}

void FixDragCluster::pack_forward_grid(int, void *buf, int nlist, int *list)
{
  drag.voidage().cells()->pack((double *) buf, nlist, list);
}

void FixDragCluster::unpack_forward_grid(int, void *buf, int nlist, int *list)
{
  drag.voidage().cells()->unpack((double *) buf, nlist, list, false);
}

void FixDragCluster::pack_reverse_grid(int, void *buf, int nlist, int *list)
{
  drag.voidage().cells()->pack((double *) buf, nlist, list);
}

void FixDragCluster::unpack_reverse_grid(int, void *buf, int nlist, int *list)
{
  drag.voidage().cells()->unpack((double *) buf, nlist, list, true);
}

/* ----------------------------------------------------------------------
   total drag force on the group, its power, most memory that the gas field takes on a rank
------------------------------------------------------------------------- */

double FixDragCluster::compute_vector(int n)
{
  if (n == 4) {
    const double mine = gas.field_bytes();
    double most = 0.0;
    MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
    return most;
  }
  if (!totals_current) {
    const double mine[4] = {totals.force[0], totals.force[1], totals.force[2], totals.power};
    MPI_Allreduce(mine, totals_all, 4, MPI_DOUBLE, MPI_SUM, world);
    totals_current = true;
  }
  return totals_all[n];
}

/* ---------------------------------------------------------------------- */

double FixDragCluster::memory_usage()
{
  return table.bytes() + gas.field_bytes();
}
