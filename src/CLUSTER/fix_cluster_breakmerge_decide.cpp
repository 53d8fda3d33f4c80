/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Which breaks and merges happen at a check, agreed across ranks.

#include "fix_cluster_breakmerge.h"

#include "local_bins.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "region.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

// a merged cluster may put in this share of its own kinetic energy, or the merge waits
static constexpr double ENERGY_TOLERANCE = 1.0e-6;

/* ---------------------------------------------------------------------- */

Body FixClusterBreakMerge::body_of(int i) const
{
  return {atom->rmass[i], to_vec3(atom->x[i]), to_vec3(atom->v[i])};
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::propose_breaks()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (test == IN_CONTACT && ncontacts[i] == 0) continue;
    if (test == CONTACT_ENDED && !contact_ended(i)) continue;
    totals[TESTS]++;
    const int n = count[i];
    BreakPlan plan;
    if (n > stable[i] && breaks(array_atom[i][1], array_atom[i][2], hysteresis))
      plan = plan_breakup(n, stable[i], limits.lo);
    if (!plan.is_event()) {
      note_whole(i);
      continue;
    }
    Event e;
    e.i = i;
    e.plan = plan;
    e.body = body_of(i);
    events.push_back(std::move(e));
    stable[i] = -stable[i];    // taken: no merge for this one
  }
}

/* ----------------------------------------------------------------------
   a pair merges if each is the other's best partner; the lower ID leads
------------------------------------------------------------------------- */

void FixClusterBreakMerge::propose_merges()
{
  exchange(SIZES, 2);
  choose_suitors();
  exchange(PARTNERS, 1);

  const tagint *tag = atom->tag;
  for (int i = 0; i < atom->nlocal; i++) {
    if (suitor[i].tag == 0) continue;
    const int image = atom->map(suitor[i].tag);
    const int j = image < 0 ? -1 : domain->closest_image(i, image);
    if (j < 0 || suitor[j].tag != tag[i]) continue;
    const int n = count[i] + count[j];
    needs[i] = needed_to_merge(i, n);
    if (suitor[i].tag < tag[i]) continue;    // the partner leads
    const int n_l = MIN(stable[i], stable[j]);
    const Body a = body_of(i), b = body_of(j);
    Event e;
    e.i = i;
    e.j = j;
    e.plan = plan_breakup(n, n_l, limits.lo);    // one piece, or a refused merge that breaks
    e.body = combine(a, b);
    if (atom->omega_flag)
      e.omega = merged_spin({a.mass, atom->radius[i], to_vec3(atom->omega[i])},
                            {b.mass, atom->radius[j], to_vec3(atom->omega[j])}, 0.5 * geometry(i).diameter(n));
    e.stiffness = suitor[i].stiffness;
    e.energy_lost = energy_lost(a, b);
    events.push_back(std::move(e));
  }
}

/* ----------------------------------------------------------------------
   best partner of each cluster among its contacts: the one that moves most alike, ties by lower ID
------------------------------------------------------------------------- */

void FixClusterBreakMerge::choose_suitors()
{
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const int *mask = atom->mask;
  const tagint *tag = atom->tag;

  std::fill(suitor, suitor + nall, Suitor{0.0, 0.0, 0});
  auto court = [&](int i, const Suitor &other) {
    if (suitor[i].tag == 0 || other.better_than(suitor[i])) suitor[i] = other;
  };

  for (const auto &contact : pairs.contacts()) {
    const int i = contact.i, j = contact.j;
    if (!(mask[i] & groupbit) || !(mask[j] & groupbit) || tag[i] == tag[j]) continue;
    if (stable[i] < 0 || stable[j] < 0) continue;
    if (&kind(i) != &kind(j)) continue;    // a cluster holds one kind of particle
    const double slip = relative_slip(to_vec3(atom->v[i]), to_vec3(atom->v[j]));
    if (!(slip < merge_tolerance)) continue;
    const int n_l = MIN(stable[i], stable[j]);
    if (!fits_together(count[i], count[j], n_l)) {
      if (!break_refused || !plan_breakup(count[i] + count[j], n_l, limits.lo).is_event()) continue;
    }
    const double stiffness = pairs.stiffness(contact);
    court(i, {slip, stiffness, tag[j]});
    if (force->newton_pair || j < nlocal) court(j, {slip, stiffness, tag[i]});
  }
  if (force->newton_pair) exchange(SUITORS, 3);
}

/* ----------------------------------------------------------------------
   place the fragments, or check the merged cluster, among all that is near: events that find no room
   wait for a later check
------------------------------------------------------------------------- */

void FixClusterBreakMerge::make_room()
{
  const int nall = atom->nlocal + atom->nghost;
  double **x = atom->x;
  const double *radius = atom->radius;
  const double largest = 0.5 * largest_diameter();

  for (Event &e : events)
    e.reach = e.plan.is_event() ? reach_of_break(e.plan, geometry(e.i), spacing, claim_max)
                                : 0.5 * geometry(e.i).diameter(e.plan.n);

  Vec3 lo, hi;
  for (int axis = 0; axis < 3; axis++) {
    lo[axis] = domain->sublo[axis] - comm->cutghost[axis];
    hi[axis] = domain->subhi[axis] + comm->cutghost[axis];
  }
  LocalBins bins(lo, hi, claim_max, nall);
  double widest = largest;
  for (int i = 0; i < nall; i++) widest = MAX(widest, radius[i]);
  for (std::size_t k = 0; k < events.size(); k++)
    bins.add(events[k].body.x, events[k].reach + widest, static_cast<int>(k));

  std::vector<std::vector<Obstacle>> obstacles(events.size());
  for (int i = 0; i < nall; i++)
    bins.near(x[i], [&](int k) {
      const Event &e = events[k];
      // parents are no obstacle to their own event; an image of one is: tags alone cannot tell
      if (i == e.i || i == e.j) return;
      const Vec3 d = to_vec3(x[i]) - e.body.x;
      const double reach = e.reach + radius[i];
      if (dot(d, d) < reach * reach) obstacles[k].push_back({d, radius[i]});
    });

  if (region) region->prematch();
  for (std::size_t k = 0; k < events.size(); k++) place(events[k], obstacles[k]);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::place(Event &e, const std::vector<Obstacle> &obstacles)
{
  if (e.plan.is_event()) {
    Walls walls;
    for (int axis = 0; axis < 3; axis++) {
      const bool wall = !domain->periodicity[axis] && !(planar && axis == 1);
      walls.lo[axis] = wall ? domain->boxlo[axis] - e.body.x[axis] : -INFINITY;
      walls.hi[axis] = wall ? domain->boxhi[axis] - e.body.x[axis] : INFINITY;
    }
    if (region)
      walls.inside = [&](const Vec3 &p, double radius) {
        const Vec3 q = e.body.x + p;
        return region->match(q[0], q[1], q[2]) && region->surface(q[0], q[1], q[2], radius) == 0;
      };
    const Turn turn(atom->tag[e.i], 0, planar ? 2 : 1, update->ntimestep / nevery);
    const int n = count[e.i] + (e.j < 0 ? 0 : count[e.j]);
    const int wanted = e.plan.pieces();
    e.placement = place_in_stages(e.plan, n, e.plan.n, limits.lo, geometry(e.i), *lattices, turn, spacing, e.reach,
                                  obstacles, walls);
    e.placement.shifted = e.placement.shifted || e.plan.pieces() < wanted;
    return;
  }

  // a merged cluster is larger than its parents' contact and may reach a third
  const double merged_radius = 0.5 * geometry(e.i).diameter(e.plan.n);
  const double mi = atom->radius[e.i], mj = atom->radius[e.j];
  const Vec3 xi = to_vec3(atom->x[e.i]) - e.body.x, xj = to_vec3(atom->x[e.j]) - e.body.x;
  e.energy_born = 0.0;
  for (const Obstacle &o : obstacles) {
    const double after = overlap_energy(e.stiffness, merged_radius + o.radius - norm(o.x));
    const double before = overlap_energy(e.stiffness, mi + o.radius - norm(o.x - xi)) +
        overlap_energy(e.stiffness, mj + o.radius - norm(o.x - xj));
    e.energy_born += MAX(0.0, after - before);
  }
  const double kinetic = 0.5 * e.body.mass * dot(e.body.v, e.body.v);
  e.placement.found = e.energy_born <= ENERGY_TOLERANCE * kinetic;
  e.placement.reach = MAX(merged_radius, MAX(norm(xi) + mi, norm(xj) + mj));
}

/* ----------------------------------------------------------------------
   An event proceeds if its ID is the lowest among all whose room it overlaps, proceeding or not.
   Candidates that found no room claim none: nothing of theirs will be there.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::arbitrate()
{
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;

  for (int i = 0; i < nlocal; i++) room[i][0] = 0.0;
  for (const Event &e : events) {
    double *r = room[e.i];
    const Vec3 shift = e.body.x - to_vec3(atom->x[e.i]);
    r[0] = e.placement.found ? e.placement.reach : 0.0;
    for (int axis = 0; axis < 3; axis++) r[1 + axis] = shift[axis];
  }
  exchange(CLAIMS, 5);

  std::vector<Claim> claims;
  for (int i = 0; i < nall; i++)
    if (room[i][0] > 0.0) claims.push_back({to_vec3(atom->x[i]) + to_vec3(&room[i][1]), room[i][0], atom->tag[i]});

  Vec3 lo, hi;
  for (int axis = 0; axis < 3; axis++) {
    lo[axis] = domain->sublo[axis] - comm->cutghost[axis];
    hi[axis] = domain->subhi[axis] + comm->cutghost[axis];
  }
  LocalBins bins(lo, hi, claim_max, nall);
  for (std::size_t k = 0; k < claims.size(); k++)
    bins.add(claims[k].centre, claims[k].radius, static_cast<int>(k));

  std::fill(proceeds, proceeds + nlocal, 0);
  std::vector<Event> proceeding;
  for (Event &e : events) {
    bool free = e.placement.found;
    if (free) {
      const Claim mine{e.body.x, e.placement.reach, atom->tag[e.i]};
      bins.near(mine.centre, mine.radius, [&](int k) { free = free && !yields_to(mine, claims[k]); });
    }
    if (free) {
      if (e.placement.shifted) totals[DEFERRED]++;
      proceeds[e.i] = 1;
      if (e.j >= 0) e.needs = needs[e.i] | needs[e.j];
      proceeding.push_back(std::move(e));
    } else totals[DEFERRED]++;
  }
  events.swap(proceeding);
}

/* ----------------------------------------------------------------------
   owned clusters whose partner leads a merge that proceeds
------------------------------------------------------------------------- */

void FixClusterBreakMerge::mark_dying()
{
  if (!merging) return;
  exchange(VERDICTS, 1);
  const tagint *tag = atom->tag;
  for (int j = 0; j < atom->nlocal; j++) {
    if (suitor[j].tag == 0 || suitor[j].tag >= tag[j]) continue;
    const int image = atom->map(suitor[j].tag);
    const int i = image < 0 ? -1 : domain->closest_image(j, image);
    if (i >= 0 && suitor[i].tag == tag[j] && proceeds[i]) dying.push_back(j);
  }
}
