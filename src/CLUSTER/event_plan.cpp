/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "event_plan.h"

#include "local_bins.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// a merged cluster may put in this share of its own kinetic energy, or the merge waits
static constexpr double ENERGY_TOLERANCE = 1.0e-6;

/* ---------------------------------------------------------------------- */

EventPlan::EventPlan(Crowd &c, const PlanRules &r, Halo &h) :
    crowd(c), rules(r), halo(h), partners(c, r, h), merging(false), taken(c.nall, 0), postponed(0), shifted(0)
{
}

/* ---------------------------------------------------------------------- */

void EventPlan::propose_break(int i, const BreakPlan &plan)
{
  Event e;
  e.i = i;
  e.particles = crowd.count[i];
  e.plan = plan;
  e.body = crowd.body(i);
  candidates.push_back(std::move(e));
  taken[i] = 1;    // no merge for this one
}

/* ---------------------------------------------------------------------- */

void EventPlan::propose_merges(const std::vector<Touch> &touches, const MergePartners::Stiffness &stiffness)
{
  merging = true;
  halo.forward(crowd.count);
  halo.forward(crowd.stable);
  halo.forward(taken);
  partners.choose(touches, stiffness, taken);
  for (int i = 0; i < crowd.nlocal; i++) {
    const int j = partners.partner(i);
    if (j < 0 || crowd.id[j] < crowd.id[i]) continue;    // the partner leads
    const int n = crowd.count[i] + crowd.count[j];
    const Body a = crowd.body(i), b = crowd.body(j);
    Event e;
    e.i = i;
    e.j = j;
    e.particles = n;
    // one piece, or a refused merge that breaks
    e.plan = plan_breakup(n, std::min(crowd.stable[i], crowd.stable[j]), rules.fewest());
    e.body = combine(a, b);
    if (crowd.omega)
      e.omega = merged_spin(crowd.spinning(i), crowd.spinning(j),
                            0.5 * rules.kinds->kind(crowd.kind[i]).diameter(n));
    e.stiffness = partners.stiffness(i);
    e.energy_lost = energy_lost(a, b);
    candidates.push_back(std::move(e));
  }
}

/* ---------------------------------------------------------------------- */

void EventPlan::settle()
{
  const auto obstacles = find_obstacles();
  for (std::size_t k = 0; k < candidates.size(); k++) place(candidates[k], obstacles[k]);
  arbitrate();
}

/* ----------------------------------------------------------------------
   all that is near each candidate, in the group or not
------------------------------------------------------------------------- */

std::vector<std::vector<Obstacle>> EventPlan::find_obstacles()
{
  double widest = 0.0;
  for (int i = 0; i < crowd.nall; i++) widest = std::max(widest, crowd.radius[i]);
  LocalBins bins(crowd.lo, crowd.hi, rules.claim, crowd.nall);
  for (std::size_t k = 0; k < candidates.size(); k++) {
    Event &e = candidates[k];
    const ClusterGeometry &particles = rules.kinds->kind(crowd.kind[e.i]);
    e.reach = e.breaks() ? reach_of_break(e.plan, particles, rules.spacing, rules.claim)
                         : 0.5 * particles.diameter(e.plan.n);
    bins.add(e.body.x, e.reach + widest, static_cast<int>(k));
  }
  std::vector<std::vector<Obstacle>> obstacles(candidates.size());
  for (int i = 0; i < crowd.nall; i++)
    bins.near(crowd.x[i], [&](int k) {
      const Event &e = candidates[k];
      // parents are no obstacle to their own event; an image of one is: IDs alone cannot tell
      if (i == e.i || i == e.j) return;
      const Vec3 d = to_vec3(crowd.x[i]) - e.body.x;
      const double reach = e.reach + crowd.radius[i];
      if (dot(d, d) < reach * reach) obstacles[k].push_back({d, crowd.radius[i]});
    });
  return obstacles;
}

/* ---------------------------------------------------------------------- */

void EventPlan::place(Event &e, const std::vector<Obstacle> &obstacles) const
{
  if (e.breaks()) place_fragments(e, obstacles);
  else place_merged(e, obstacles);
}

void EventPlan::place_fragments(Event &e, const std::vector<Obstacle> &obstacles) const
{
  const Turn turn(crowd.id[e.i], 0, rules.planar ? 2 : 1, rules.check);
  const int wanted = e.plan.pieces();
  e.placement = place_in_stages(e.plan, e.particles, e.plan.n, rules.fewest(), rules.kinds->kind(crowd.kind[e.i]),
                                *rules.lattices, turn, rules.spacing, e.reach, obstacles,
                                crowd.walls_around(e.body.x));
  e.placement.shifted = e.placement.shifted || e.plan.pieces() < wanted;
}

// a merged cluster is larger than its parents' contact and may reach a third

void EventPlan::place_merged(Event &e, const std::vector<Obstacle> &obstacles) const
{
  const double merged_radius = e.reach;
  const double mi = crowd.radius[e.i], mj = crowd.radius[e.j];
  const Vec3 xi = to_vec3(crowd.x[e.i]) - e.body.x, xj = to_vec3(crowd.x[e.j]) - e.body.x;
  e.energy_born = 0.0;
  for (const Obstacle &o : obstacles) {
    const double after = overlap_energy(e.stiffness, merged_radius + o.radius - norm(o.x));
    const double before = overlap_energy(e.stiffness, mi + o.radius - norm(o.x - xi)) +
        overlap_energy(e.stiffness, mj + o.radius - norm(o.x - xj));
    e.energy_born += std::max(0.0, after - before);
  }
  const double kinetic = 0.5 * e.body.mass * dot(e.body.v, e.body.v);
  e.placement.found = e.energy_born <= ENERGY_TOLERANCE * kinetic;
  e.placement.reach = std::max(merged_radius, std::max(norm(xi) + mi, norm(xj) + mj));
}

/* ----------------------------------------------------------------------
   An event proceeds if its ID is the lowest among all whose room it overlaps, proceeding or not.
   Candidates that found no room claim none: nothing of theirs will be there.
------------------------------------------------------------------------- */

void EventPlan::arbitrate()
{
  struct Room {
    double radius = 0.0;
    Vec3 shift = {};    // of its centre from the cluster that leads
  };
  std::vector<Room> rooms(crowd.nall);
  for (const Event &e : candidates)
    if (e.placement.found) rooms[e.i] = {e.placement.reach, e.body.x - to_vec3(crowd.x[e.i])};
  halo.forward(rooms);

  std::vector<Claim> claims;
  for (int i = 0; i < crowd.nall; i++)
    if (rooms[i].radius > 0.0)
      claims.push_back({to_vec3(crowd.x[i]) + rooms[i].shift, rooms[i].radius, crowd.id[i]});
  LocalBins bins(crowd.lo, crowd.hi, rules.claim, crowd.nall);
  for (std::size_t k = 0; k < claims.size(); k++)
    bins.add(claims[k].centre, claims[k].radius, static_cast<int>(k));

  std::vector<char> proceeds(crowd.nall, 0);
  for (Event &e : candidates) {
    bool free = e.placement.found;
    if (free) {
      const Claim mine{e.body.x, e.placement.reach, crowd.id[e.i]};
      bins.near(mine.centre, mine.radius, [&](int k) { free = free && !yields_to(mine, claims[k]); });
    }
    if (!free) {
      postponed++;
      continue;
    }
    if (e.placement.shifted) shifted++;
    proceeds[e.i] = 1;
    proceeding.push_back(std::move(e));
  }
  if (merging) find_dying(proceeds);
}

/* ----------------------------------------------------------------------
   owned clusters whose partner leads a merge that proceeds
------------------------------------------------------------------------- */

void EventPlan::find_dying(const std::vector<char> &mine)
{
  std::vector<char> proceeds(mine);
  halo.forward(proceeds);
  for (int j = 0; j < crowd.nlocal; j++) {
    const int i = partners.partner(j);
    if (i >= 0 && crowd.id[i] < crowd.id[j] && proceeds[i]) vanishing.push_back(j);
  }
}
