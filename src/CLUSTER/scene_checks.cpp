/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "scene_checks.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "model/placement.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

static constexpr double MOST_SITES = 1.0e7;    // of a lattice for fragments: 0.4 GB

/* ---------------------------------------------------------------------- */

void SceneChecks::check_engine(Requirements &all) const
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    all.unmet(fmt::format("{} does not support run_style respa: use run_style verlet", me));
  if ((settings.event.breaking || settings.event.merging) && reruns())
    all.unmet(fmt::format(
        "{} does not support rerun of events: a dump holds the places of other clusters than there are "
        "now. Use 'break no merge no' for the dump of a run without events",
        me));
  const std::string units = foreign_units(lmp, me);
  all.unmet_if(!units.empty(), units);
  if (!settings.size.gravity_given && strcmp(update->unit_style, "si") != 0)
    all.unmet(fmt::format("{}: the keyword gravity is required with units {}: its default is 9.81 m/s^2 along z",
                          me, update->unit_style));
  if (find_fixes(lmp, "^cluster/breakmerge").size() > 1)
    all.unmet(fmt::format("{}: only one fix cluster/breakmerge at a time", me));
}

/* ----------------------------------------------------------------------
   nobody is told; but a run starts at the step that there is, and lasts as long as it says
------------------------------------------------------------------------- */

bool SceneChecks::reruns() const
{
  return update->whichflag == 1 &&
      (update->ntimestep != update->firststep || update->laststep - update->firststep != update->nsteps);
}

/* ----------------------------------------------------------------------
   Events are decided before pre_exchange, with the clusters and the places that there are then. Fixes that add, delete
   or move clusters between ranks do so in pre_exchange, too: they must find the events done.
------------------------------------------------------------------------- */

void SceneChecks::check_order(Requirements &all) const
{
  bool after_me = false;
  for (Fix *other : all_fixes(lmp)) {
    const bool history = utils::strmatch(other->id, "^NEIGH_HISTORY");
    if (other == fix) after_me = true;
    else if (after_me && history)
      all.unmet(fmt::format("{} must be defined after the pair_style command: contact history is saved "
                            "in the order of definition",
                            me));
    else if (!after_me && !history && other->force_reneighbor && (other->setmask() & PRE_EXCHANGE))
      all.unmet(
          fmt::format("{} must be defined before fix {} {}: breakups and merges of a step are carried out before "
                      "other fixes add, delete or migrate clusters",
                      me, other->style, other->id));
  }
}

/* ---------------------------------------------------------------------- */

void SceneChecks::check_foreign(Requirements &all) const
{
  const std::string foreign = not_for_clusters(lmp, fix->groupbit);
  if (!foreign.empty()) all.unmet(fmt::format("{} does not support {}", me, foreign));
}

/* ---------------------------------------------------------------------- */

void SceneChecks::check_room(Requirements &all) const
{
  const double largest = settings.kinds.largest_diameter();
  const double claim = settings.event.claim, spacing = settings.event.spacing;
  if (claim < largest)
    all.unmet(fmt::format("{}: claim {:.6g} [length] is below the largest cluster diameter {}: use a larger claim "
                          "or a lower upper limit",
                          me, claim, rounded_up(largest)));
  const double halves = room_of_halves(largest, spacing);
  if (settings.event.breaking && claim < halves)
    all.unmet(fmt::format("{}: claim {:.6g} [length] is below {}, the room that two halves of the largest cluster "
                          "need at spacing {}: the largest could never break",
                          me, claim, rounded_up(halves), spacing));
  const std::string fault = periodic_box_too_short();
  if (!fault.empty()) all.unmet(fault);
}

/* ----------------------------------------------------------------------
   Two events meet when their claims do: each rank must see every candidate within two claims of its own clusters, and what
   is no candidate as far away as it reaches into a claim.
------------------------------------------------------------------------- */

void SceneChecks::check_ghosts(Requirements &all, const LargestDiameters &largest) const
{
  const double claim = settings.event.claim, skin = neighbor->skin;
  const bool anyone = largest.group_is_empty();    // clusters of any type may come
  double farthest = 0.0;
  std::string fault;
  for (int type = 1; type <= atom->ntypes; type++) {
    auto need = [&](double reach, double radius, const std::string &why) {
      const double have = ghost_reach(lmp, type, radius);
      if (have >= reach * (1.0 - 1.0e-12) || reach <= farthest) return;
      farthest = reach;
      fault = fmt::format("{}: the ghost cutoff{} {:.6g} is below {}, {}", me, ghosts_of_a_type(lmp, type), have,
                          rounded_up(reach), why);
    };
    if (largest.in_group(type) || anyone)
      need(2.0 * claim + skin, 0.0, fmt::format("twice the claim {:.6g} plus the skin", claim));
    const double radius = 0.5 * largest.outside(type);
    if (radius > 0.0)
      need(claim + radius + skin, radius,
           fmt::format(
               "the claim {:.6g} plus the largest radius {:.6g} of atoms of type {} outside of the group and the "
               "skin, so that a "
               "rank would place clusters into what it does not see",
               claim, radius, type));
  }
  if (!fault.empty())
    all.unmet(fmt::format("{}: use '{}' or a smaller claim", fault, ask_for_ghosts(lmp, farthest)));
}

/* ---------------------------------------------------------------------- */

std::string SceneChecks::periodic_box_too_short() const
{
  for (int axis = 0; axis < 3; axis++)
    if (domain->periodicity[axis] && !(settings.event.planar && axis == 1) &&
        domain->prd[axis] < 4.0 * settings.event.claim)
      return fmt::format("{}: the periodic box is {:.6g} long along {}, below four times the claim {:.6g}: an "
                         "event would meet its own image",
                         me, domain->prd[axis], "xyz"[axis], settings.event.claim);
  return "";
}

/* ---------------------------------------------------------------------- */

void SceneChecks::check_lattice(Requirements &all) const
{
  const double finest = settings.event.spacing * settings.kinds.smallest_diameter();
  const double sites =
      ClusterDEM::Lattice::sites_within(settings.event.planar, settings.event.claim / finest + 1.0);
  if (sites > MOST_SITES)
    all.unmet(fmt::format(
        "{}: the claim {:.6g} [length] holds {:.3g} sites of a lattice for fragments of {} particles, more than "
        "{:.3g}: raise the lower limit or the spacing, or use a smaller claim",
        me, settings.event.claim, sites, settings.kinds.limits.lo, MOST_SITES));
}

/* ---------------------------------------------------------------------- */

void SceneChecks::check_part_of_box() const
{
  const double claim = settings.event.claim;
  for (int axis = 0; axis < 3; axis++) {
    const double part = domain->subhi[axis] - domain->sublo[axis];
    if (part < claim && part < domain->prd[axis] * (1.0 - 1.0e-12))
      error->one(FLERR,
                 "{}: a rank's part of the box is {:.6g} long along {}, below the claim {:.6g}: use "
                 "fewer ranks or a smaller claim",
                 me, part, "xyz"[axis], claim);
  }
  const std::string fault = periodic_box_too_short();
  if (!fault.empty()) error->one(FLERR, "{}", fault);
}
