/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "event_plan.h"

#include "local_bins.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

EventPlan::EventPlan(Crowd &c, const PlanRules &r, Halo &h) :
    crowd(c), rules(r), halo(h), partners(c, r, h), merging(false), postponed(0), shifted(0), rounds_(0)
{
}

/* ---------------------------------------------------------------------- */

void EventPlan::propose_break(int i, const BreakPlan &plan)
{
  Event e;
  e.i = i;
  e.particles = crowd.size[i].count;
  e.plan = plan;
  e.body = crowd.body(i);
  candidates.push_back(std::move(e));
  crowd.size[i].taken = 1;    // no merge for this one
}

/* ---------------------------------------------------------------------- */

void EventPlan::propose_merges(const std::vector<Touch> &touches)
{
  merging = true;
  halo.forward(crowd.size);
  partners.choose(touches);
  for (int i = 0; i < crowd.nlocal; i++) {
    const int j = partners.partner(i);
    if (j < 0 || crowd.id[j] < crowd.id[i]) continue;    // the partner leads
    const Body a = crowd.body(i), b = crowd.body(j);
    Event e;
    e.i = i;
    e.j = j;
    e.particles = crowd.size[i].count + crowd.size[j].count;
    // one piece, or a refused merge that breaks
    e.plan = plan_breakup(e.particles, std::min(crowd.size[i].stable, crowd.size[j].stable), rules.fewest());
    e.body = combine(a, b);
    if (crowd.omega)
      e.omega = merged_spin(crowd.spinning(i), crowd.spinning(j),
                            0.5 * rules.kinds->kind(crowd.kind[i]).diameter(e.particles));
    e.energy_lost = energy_lost(a, b);
    candidates.push_back(std::move(e));
  }
}

/* ---------------------------------------------------------------------- */

void EventPlan::settle()
{
  std::sort(candidates.begin(), candidates.end(),
            [&](const Event &a, const Event &b) { return crowd.id[a.i] < crowd.id[b.i]; });
  open_rooms();
  const auto neighbors = find_neighbors();
  while (halo.anywhere(settle_those_that_can(neighbors))) halo.forward(rooms);
  for (Event &e : candidates)
    if (e.placement.found) proceeding.push_back(std::move(e));
  if (!merging) return;
  halo.forward(rooms);
  find_dying();
}

/* ----------------------------------------------------------------------
   each candidate tells how far it may reach
------------------------------------------------------------------------- */

void EventPlan::open_rooms()
{
  rooms.assign(crowd.nall, Room());
  for (Event &e : candidates) {
    const ClusterGeometry &particles = rules.kinds->kind(crowd.kind[e.i]);
    e.reach = e.breaks() ? reach_of_break(e.plan, particles, rules.spacing, rules.claim)
                         : 0.5 * particles.diameter(e.particles);
    rooms[e.i] = {OPEN, e.reach, e.body.x - to_vec3(crowd.x[e.i])};
  }
  halo.forward(rooms);
}

Vec3 EventPlan::centre(int leader) const
{
  return to_vec3(crowd.x[leader]) + rooms[leader].shift;
}

/* ----------------------------------------------------------------------
   all clusters that are near each candidate, in the group or not, and all candidates with lower IDs
------------------------------------------------------------------------- */

std::vector<EventPlan::Neighbors> EventPlan::find_neighbors() const
{
  double widest = 0.0;
  for (int i = 0; i < crowd.nall; i++) widest = std::max({widest, crowd.radius[i], rooms[i].radius});
  LocalBins bins(crowd.lo, crowd.hi, rules.claim, crowd.nall);
  for (std::size_t k = 0; k < candidates.size(); k++)
    bins.add(candidates[k].body.x, candidates[k].reach + widest, static_cast<int>(k));

  std::vector<Neighbors> found(candidates.size());
  auto meets = [&](const Event &e, const Vec3 &x, double radius) {
    const Vec3 d = x - e.body.x;
    const double reach = e.reach + radius;
    return dot(d, d) < reach * reach;
  };
  for (int i = 0; i < crowd.nall; i++) {
    bins.near(crowd.x[i], [&](int k) {
      const Event &e = candidates[k];
      // parents are no obstacle to their own event; an image of one is: IDs alone cannot tell
      if (i != e.i && i != e.j && meets(e, to_vec3(crowd.x[i]), crowd.radius[i])) found[k].clusters.push_back(i);
    });
    if (rooms[i].state == NONE) continue;
    const Vec3 x = centre(i);
    bins.near(x.data(), [&](int k) {
      const Event &e = candidates[k];
      if (crowd.id[i] < crowd.id[e.i] && meets(e, x, rooms[i].radius)) found[k].rivals.push_back(i);
    });
  }
  return found;
}

/* ----------------------------------------------------------------------
   one after the other; true if any is still open
------------------------------------------------------------------------- */

bool EventPlan::settle_those_that_can(const std::vector<Neighbors> &neighbors)
{
  rounds_++;
  bool open = false;
  for (std::size_t k = 0; k < candidates.size(); k++) {
    Event &e = candidates[k];
    if (rooms[e.i].state != OPEN) continue;
    bool ready = true;
    for (const int rival : neighbors[k].rivals) ready = ready && rooms[rival].state != OPEN;
    if (ready) settle_one(e, neighbors[k]);
    else open = true;
  }
  return open;
}

void EventPlan::settle_one(Event &e, const Neighbors &neighbors)
{
  if (e.breaks()) place_fragments(e, neighbors);
  else place_merged(e, neighbors);
  rooms[e.i].state = e.placement.found ? PROCEEDS : WAITS;
  rooms[e.i].radius = e.placement.reach;
  if (!e.placement.found) postponed++;
  else if (e.placement.shifted) shifted++;
}

/* ----------------------------------------------------------------------
   fragments stay clear of clusters and of rooms that are taken
------------------------------------------------------------------------- */

void EventPlan::place_fragments(Event &e, const Neighbors &neighbors) const
{
  std::vector<Obstacle> obstacles;
  for (const int i : neighbors.clusters) obstacles.push_back({to_vec3(crowd.x[i]) - e.body.x, crowd.radius[i]});
  for (const int i : neighbors.rivals)
    if (rooms[i].state == PROCEEDS) obstacles.push_back({centre(i) - e.body.x, rooms[i].radius});
  const Turn turn(crowd.id[e.i], 0, rules.planar ? 2 : 1, rules.check);
  const int wanted = e.plan.pieces();
  e.placement =
      place_in_stages(e.plan, e.particles, e.plan.n, rules.fewest(), rules.kinds->kind(crowd.kind[e.i]),
                      *rules.lattices, turn, rules.spacing, e.reach, obstacles, crowd.walls_around(e.body.x));
  e.placement.shifted = e.placement.shifted || e.plan.pieces() < wanted;
}

/* ----------------------------------------------------------------------
   a merged cluster is larger than its parents' contact and may reach a third, or a wall
------------------------------------------------------------------------- */

void EventPlan::place_merged(Event &e, const Neighbors &neighbors) const
{
  const double radius = e.reach;
  e.energy_born = 0.0;
  for (const int o : neighbors.clusters) {
    auto energy = [&](int i, double r, const Vec3 &x) {
      return crowd.contact_energy(i, o, r, norm(to_vec3(crowd.x[o]) - x));
    };
    const double after = energy(e.i, radius, e.body.x);
    e.energy_after += after;
    e.energy_born += birth_energy(after,
                                  energy(e.i, crowd.radius[e.i], to_vec3(crowd.x[e.i])) +
                                      energy(e.j, crowd.radius[e.j], to_vec3(crowd.x[e.j])));
  }
  e.placement.found = negligible_birth(e.energy_born, e.body) && crowd.walls_around(e.body.x).contains({}, radius);
  for (const int i : neighbors.rivals)
    if (rooms[i].state == PROCEEDS)
      e.placement.found = e.placement.found && norm(centre(i) - e.body.x) >= rooms[i].radius + radius;
  e.placement.reach = radius;
}

/* ----------------------------------------------------------------------
   owned clusters whose partner leads a merge that proceeds
------------------------------------------------------------------------- */

void EventPlan::find_dying()
{
  for (int j = 0; j < crowd.nlocal; j++) {
    const int i = partners.partner(j);
    if (i >= 0 && rooms[i].state == PROCEEDS) vanishing.push_back(j);
  }
}
