/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Checks of the clusters themselves: who moves them, where they lie, how long their contacts last.

#include "scene_checks.h"

#include "model/step_control.h"

#include "atom.h"
#include "domain.h"
#include "force.h"
#include "group.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ----------------------------------------------------------------------
   the size law's g is its own: the engine's fix tells what acts on clusters
------------------------------------------------------------------------- */

void SceneChecks::check_gravity(Requirements &all) const
{
  for (Fix *other : find_fixes(lmp, "^gravity")) {
    int dim = 0;
    const auto *acceleration = static_cast<const double *>(other->extract("gvec", dim));
    if (!acceleration) continue;
    const Vec3 g = to_vec3(acceleration);
    const double along = g[settings.size.gravity_axis], mine = settings.size.gravity;
    if (norm(g) > 0.0 && std::fabs(std::fabs(along) - mine) > 1.0e-3 * mine)
      all.warn(
          fmt::format("{}: gravity {} along {} of the size law is not that of fix {} {}, {:.4g} {:.4g} {:.4g}", me,
                      mine, "xyz"[settings.size.gravity_axis], other -> style, other -> id, g[0], g[1], g[2]));
  }
}

/* ---------------------------------------------------------------------- */

bigint SceneChecks::count_outside(int other) const
{
  bigint mine = 0, sum = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & fix->groupbit) && !(atom->mask[i] & other)) mine++;
  MPI_Allreduce(&mine, &sum, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return sum;
}

void SceneChecks::check_groups(Requirements &all) const
{
  if (count_outside(0) == 0)
    all.warn(fmt::format("{}: there is no cluster in its group {}", me, group->names[fix->igroup]));
  const std::string mine = group->names[fix->igroup];
  if (!settings.size.drag_id.empty()) {
    const Fix *drag = find_fix(lmp, settings.size.drag_id);
    const bigint outside = drag ? count_outside(drag->groupbit) : 0;
    if (outside)
      all.unmet(fmt::format(
          "{}: {} clusters of its group {} are not in the group {} of fix drag/cluster {}, and would have "
          "sizes for a drag that they do not feel: give both fixes one group",
          me, outside, mine, group->names[drag->igroup], drag->id));
  }
  if (find_fixes(lmp, "^nve/cluster").empty()) return;
  int moved = 0;
  for (const Fix *other : all_fixes(lmp))
    if (other->time_integrate) moved |= other->groupbit;
  const bigint still = count_outside(moved);
  if (still)
    all.unmet(
        fmt::format("{}: {} clusters of its group {} are moved by no fix: give fix nve/cluster the same group", me,
                    still, mine));
}

/* ---------------------------------------------------------------------- */

void SceneChecks::check_plane(Requirements &all) const
{
  if (!settings.event.planar || !settings.event.breaking) return;
  const double largest = settings.kinds.largest_diameter();
  if (!settings.event.plane_given) {
    if (domain->prd[1] > 2.0 * largest * (1.0 + 1.0e-12))
      all.warn(fmt::format("{}: the box is {:.4g} thick along y, more than two of the largest clusters of {:.4g}, "
                           "and the keyword plane is not "
                           "given: its default xz places the fragments of a cluster in its own xz plane. Say "
                           "'plane none' for fragments in "
                           "all directions, or 'plane xz'",
                           me, domain->prd[1], largest));
    return;
  }
  double mine[4] = {-INFINITY, -INFINITY, 0.0, 0.0}, most[4];    // -lowest and highest y, largest |v_y| and |v|
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & fix->groupbit)) continue;
    mine[0] = std::max(mine[0], -atom->x[i][1]);
    mine[1] = std::max(mine[1], atom->x[i][1]);
    mine[2] = std::max(mine[2], std::fabs(atom->v[i][1]));
    mine[3] = std::max(mine[3], norm(to_vec3(atom->v[i])));
  }
  MPI_Allreduce(mine, most, 4, MPI_DOUBLE, MPI_MAX, world);
  if (most[0] + most[1] > 1.0e-6 * largest)
    all.unmet(fmt::format(
        "{}: with plane xz all clusters must lie in one plane, but their y go from {:.6g} to {:.6g}: use "
        "plane none, or set y to one value",
        me, -most[0], most[1]));
  if (most[2] > 1.0e-9 * most[3])
    all.unmet(fmt::format(
        "{}: with plane xz clusters must not move along y, but one does at {:.4g}: use plane none, or set vy "
        "to 0",
        me, most[2]));
}

/* ----------------------------------------------------------------------
   A step that is short enough for the contacts of now may be too long for those of fragments. The paper's bound is
   pi/5 sqrt(m/k); fix cluster/timestep keeps it by itself.
------------------------------------------------------------------------- */

void SceneChecks::check_step(Requirements &all, double stiffness) const
{
  if (!(stiffness > 0.0) || !find_fixes(lmp, "^cluster/timestep").empty()) return;
  double mine = -INFINITY, most;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, -atom->rmass[i]);
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  const double now = -most, dt = update->dt;
  double fragment = now;
  for (int k = 0; settings.event.breaking && k < settings.kinds.count(); k++)
    fragment = std::min(fragment, settings.kinds.kind(k).mass(settings.kinds.limits.lo));
  for (const auto &[mass, whose] :
       {std::pair{now, std::string("the lightest cluster")},
        std::pair{fragment,
                  fmt::format("a fragment of {} particles, the lower limit", settings.kinds.limits.lo)}}) {
    const double bound = contact_step(PAPER_CONTACT_SHARE, mass, stiffness);
    if (dt <= bound || !std::isfinite(bound)) continue;
    all.warn(fmt::format(
        "{}: the time step {:.4g} is above {:.4g}, pi/5 sqrt(m/k) of {} (m = {:.4g}, k = {:.4g}): its contacts "
        "are not "
        "resolved, and clusters may be lost. Use a shorter step, fix cluster/timestep, or a higher lower limit",
        me, dt, bound, whose, mass, stiffness));
    return;
  }
}
