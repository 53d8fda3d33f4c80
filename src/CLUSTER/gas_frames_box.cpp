/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// How the grid of a gas field meets the box: its edges, and the part of it that this rank holds.

#include "gas_frames.h"

#include "error.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// have the ends of a box changed since they were noted?
bool GasFrames::outdated(std::array<double, 6> &ends, const double *lower, const double *upper) const
{
  const std::array<double, 6> now_they_are = {lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]};
  if (ends == now_they_are) return false;
  ends = now_they_are;
  return true;
}

/* ---------------------------------------------------------------------- */

void GasFrames::fit_box()
{
  outdated(box, domain->boxlo, domain->boxhi);
  for (int axis = 0; axis < 3; axis++) fit_axis(axis);
  mine.fill(NAN);    // no part is known in the new axes
}

/* ----------------------------------------------------------------------
   The box may reach one spacing of the grid beyond its outermost planes (values in the centres of cells end half a
   cell inside of a wall), farther only where the command says what holds there.
------------------------------------------------------------------------- */

void GasFrames::fit_axis(int axis)
{
  const std::vector<double> &planes = series.planes()[axis];
  const char name = "xyz"[axis];
  const double boxlo = domain->boxlo[axis], length = domain->prd[axis];
  const bool box_periodic = domain->periodicity[axis];
  const bool periodic = edges[axis] == PERIODIC || (edges[axis] == AS_THE_BOX && box_periodic);
  if (edges[axis] == PERIODIC && !box_periodic)
    error->all(FLERR, "{}: edge {} periodic needs a box that is periodic along {}: use 'edge {} clamp'",
               series.name(), name, name, name);

  if (planes.size() == 1) {
    axes[axis] = GridAxis(planes, Fold());
    return;
  }
  const double extent = planes.back() - planes.front();
  if (periodic && extent > length && !GridAxis::closes(planes, length))
    error->all(
        FLERR,
        "{}: the field is {} long along {}, from {} to {}, more than the period, the length {} of the box: use "
        "'edge {} clamp'",
        series.name(), extent, name, planes.front(), planes.back(), length, name);
  if (edges[axis] == AS_THE_BOX) {
    const double below = planes[1] - planes[0], above = planes.back() - planes[planes.size() - 2];
    const double rounding = 1.0e-6 * length;
    if (boxlo < planes.front() - below - rounding || boxlo + length > planes.back() + above + rounding)
      error->all(
          FLERR,
          "{}: the box reaches from {} to {} along {}, the field from {} to {}, and no more than one spacing "
          "of its points beyond: use a field that covers the box, or say what holds outside of it by 'edge {} "
          "clamp'{}",
          series.name(), boxlo, boxlo + length, name, planes.front(), planes.back(), name,
          box_periodic ? fmt::format(" or 'edge {} periodic'", name) : "");
  }
  axes[axis] = periodic ? GridAxis::periodic(planes, length)
                        : GridAxis(planes, box_periodic ? Fold{boxlo, length} : Fold());
}

/* ----------------------------------------------------------------------
   this rank's part of the box, and as far beyond it as clusters go between two rebuilds of the neighbor lists
------------------------------------------------------------------------- */

void GasFrames::fit_part()
{
  for (int k = 0; k < 3; k++) {
    lo[k] = domain->sublo[k] - neighbor->skin;
    hi[k] = domain->subhi[k] + neighbor->skin;
  }
  const GridPart needed(axes, lo, hi);
  if (needed == part && held[0].values.size() == part.points() * nvalues) return;
  part = needed;
  for (Held &frame : held) frame = Held();
}

/* ----------------------------------------------------------------------
   a cluster is farther out than expected, as with lists that are rebuilt seldom: the part grows to hold it
------------------------------------------------------------------------- */

void GasFrames::reach(const double *x)
{
  for (int k = 0; k < 3; k++) {
    double nearest = x[k];
    if (domain->periodicity[k]) {
      const double length = domain->prd[k];
      nearest -= length * std::round((nearest - 0.5 * (lo[k] + hi[k])) / length);
    }
    lo[k] = std::min(lo[k], nearest - neighbor->skin);
    hi[k] = std::max(hi[k], nearest + neighbor->skin);
  }
  part = GridPart(axes, lo, hi);
  for (Held &frame : held) frame = Held();
  hold(now);
}
