// The plan of a check, on one to four made-up ranks, against a serial loop over ascending IDs that is written down here a
// second time.

#include "made_up_ranks.h"
#include "model_testing.h"

#include "event_plan.h"

#include <algorithm>
#include <map>

using namespace ClusterDEM;
using LAMMPS_NS::ClusterID;
using LAMMPS_NS::Crowd;
using LAMMPS_NS::Event;
using LAMMPS_NS::EventPlan;
using LAMMPS_NS::PlanRules;
using LAMMPS_NS::Touch;

namespace {

constexpr double SIDE = 1.0 / 128;          // m: a power of two, so that images are exact
constexpr double STIFFNESS = 10.0;          // N/m
constexpr double GRID = 1.0 / (1 << 24);    // of places

struct Cluster {
  ClusterID id;
  double x[3], v[3], radius, mass;
  int kind, count, stable;    // kind < 0: only in the way
};

struct Scene {
  std::vector<Cluster> clusters;
  PlanRules rules;
  bool newton;
};

double wrapped(double d)    // along x, the periodic side
{
  return d - SIDE * std::round(d / SIDE);
}

Vec3 apart(const Vec3 &from, const Vec3 &to)
{
  return {wrapped(to[0] - from[0]), to[1] - from[1], to[2] - from[2]};
}

double spring(double overlap)
{
  return overlap > 0.0 ? 0.5 * STIFFNESS * overlap * overlap : 0.0;
}

Walls floor_and_lid(const Vec3 &origin)
{
  return {{-INFINITY, -INFINITY, -origin[2]}, {INFINITY, INFINITY, SIDE - origin[2]}};
}

BreakPlan wanted_break(const Cluster &c, const PlanRules &rules)
{
  if (c.kind < 0 || c.count <= 2 * c.stable) return {};
  const BreakPlan plan = plan_breakup(c.count, c.stable, rules.fewest());
  return plan.is_event() ? plan : BreakPlan{};
}

Scene draw(RandomInputs &random, const ClusterKinds &kinds, const Lattices &lattices)
{
  Scene s;
  s.rules.kinds = &kinds;
  s.rules.lattices = &lattices;
  s.rules.merge_tolerance = 0.01;
  s.rules.break_refused = random.integer(0, 3) == 0;
  s.rules.claim = 1.6 * kinds.largest_diameter();
  s.rules.spacing = random.coin() ? 2.0 : 1.0;
  s.rules.check = random.integer(0, 1000);
  s.newton = random.coin();
  const int wanted = random.integer(2, 60);
  const bool alike = random.coin();    // velocities that are equal to the last bit: slips that tie
  for (int tries = 0; tries < 400 && static_cast<int>(s.clusters.size()) < wanted; tries++) {
    Cluster c = {};
    c.kind = random.integer(0, 9) == 0 ? -1 : 0;
    c.count = random.integer(0, 3) ? random.integer(3, 60) : random.integer(60, 400);
    c.stable = random.integer(0, 2) ? 400 : random.integer(3, 100);
    c.radius = 0.5 * kinds.kind(0).diameter(c.count);
    c.mass = kinds.kind(0).mass(c.count);
    c.x[0] = GRID * random.integer(0, static_cast<int>(SIDE / GRID) - 1);
    c.x[2] = GRID * random.integer(0, static_cast<int>(SIDE / GRID) - 1);
    c.v[2] = 1.0;
    if (!alike)
      for (int axis : {0, 2}) c.v[axis] += random.uniform(-0.01, 0.01);
    if (!s.clusters.empty() && random.coin()) {    // beside another one
      const Cluster &other = s.clusters[random.integer(0, static_cast<int>(s.clusters.size()) - 1)];
      const double angle = random.uniform(0.0, 2.0 * PI), reach = 0.999 * (other.radius + c.radius);
      c.x[0] = GRID * std::round((other.x[0] + reach * std::cos(angle)) / GRID);
      c.x[2] = GRID * std::round((other.x[2] + reach * std::sin(angle)) / GRID);
      c.x[0] -= SIDE * std::floor(c.x[0] / SIDE);
    }
    bool free = c.x[2] >= c.radius && c.x[2] <= SIDE - c.radius;
    for (const Cluster &other : s.clusters)
      free = free && norm(apart(to_vec3(c.x), to_vec3(other.x))) > 0.99 * (c.radius + other.radius);
    if (free) s.clusters.push_back(c);
  }
  // IDs in an order that says nothing of places
  std::vector<ClusterID> ids(s.clusters.size());
  for (std::size_t k = 0; k < ids.size(); k++) ids[k] = 1 + 3 * static_cast<ClusterID>(k);
  for (int k = static_cast<int>(ids.size()) - 1; k > 0; k--) std::swap(ids[k], ids[random.integer(0, k)]);
  for (std::size_t k = 0; k < ids.size(); k++) s.clusters[k].id = ids[k];
  return s;
}

// what is compared
struct Outcome {
  ClusterID partner = 0;
  int pieces = 0;
  Vec3 first = {};    // centre of the last piece, or of the merged cluster, from the leading cluster
  double energy = 0.0;
};
using Outcomes = std::map<ClusterID, Outcome>;

// ---- the reference: one after the other

struct SerialPlan {
  const Scene &s;
  Outcomes outcomes;
  int waiting = 0;
  struct Taken {
    Vec3 centre;
    double radius;
  };
  std::vector<Taken> taken;

  explicit SerialPlan(const Scene &scene) : s(scene)
  {
    struct Candidate {
      const Cluster *i, *j;
      BreakPlan plan;
    };
    std::map<ClusterID, Candidate> candidates;
    std::map<ClusterID, bool> busy;
    for (const Cluster &c : s.clusters) {
      const BreakPlan plan = wanted_break(c, s.rules);
      if (!plan.is_event()) continue;
      candidates[c.id] = {&c, nullptr, plan};
      busy[c.id] = true;
    }
    // all contacts by slip, then IDs
    std::vector<std::tuple<double, ClusterID, ClusterID, const Cluster *, const Cluster *>> contacts;
    for (const Cluster &a : s.clusters)
      for (const Cluster &b : s.clusters) {
        if (a.id >= b.id || a.kind < 0 || a.kind != b.kind) continue;
        if (norm(apart(to_vec3(a.x), to_vec3(b.x))) >= a.radius + b.radius) continue;
        const double dv = norm(to_vec3(a.v) - to_vec3(b.v));
        const double slip = dv / std::min(norm(to_vec3(a.v)), norm(to_vec3(b.v)));
        const int n_l = std::min(a.stable, b.stable);
        const bool fits = a.count + b.count <= n_l;
        const bool refused =
            s.rules.break_refused && plan_breakup(a.count + b.count, n_l, s.rules.fewest()).is_event();
        if (slip < s.rules.merge_tolerance && (fits || refused)) contacts.emplace_back(slip, a.id, b.id, &a, &b);
      }
    std::sort(contacts.begin(), contacts.end());
    for (const auto &[slip, low, high, a, b] : contacts) {
      if (busy[low] || busy[high]) continue;
      busy[low] = busy[high] = true;
      candidates[low] = {a, b,
                         plan_breakup(a->count + b->count, std::min(a->stable, b->stable), s.rules.fewest())};
    }
    for (const auto &[id, c] : candidates) go(*c.i, c.j, c.plan);    // by ascending ID
  }

  void go(const Cluster &i, const Cluster *j, BreakPlan plan)
  {
    Body body{i.mass, to_vec3(i.x), to_vec3(i.v)};
    if (j) body = combine(body, {j->mass, to_vec3(i.x) + apart(to_vec3(i.x), to_vec3(j->x)), to_vec3(j->v)});
    const int n = i.count + (j ? j->count : 0);
    const ClusterGeometry &particles = s.rules.kinds->kind(0);
    Outcome outcome;
    outcome.partner = j ? j->id : 0;
    Taken room{body.x, 0.0};
    if (plan.is_event()) {
      const double reach = reach_of_break(plan, particles, s.rules.spacing, s.rules.claim);
      std::vector<Obstacle> obstacles;
      for (const Cluster &o : s.clusters)
        if (o.id != i.id && (!j || o.id != j->id)) obstacles.push_back({apart(body.x, to_vec3(o.x)), o.radius});
      for (const Taken &t : taken) obstacles.push_back({apart(body.x, t.centre), t.radius});
      const Placement placed = place_in_stages(plan, n, plan.n, s.rules.fewest(), particles, *s.rules.lattices,
                                               Turn(i.id, 0, 2, s.rules.check), s.rules.spacing, reach, obstacles,
                                               floor_and_lid(body.x));
      if (!placed.found) {
        waiting++;
        return;
      }
      outcome.pieces = plan.pieces();
      outcome.first = body.x + placed.centres.back() - to_vec3(i.x);
      room.radius = placed.reach;
    } else {
      room.radius = 0.5 * particles.diameter(n);
      bool free = body.x[2] >= room.radius && body.x[2] + room.radius <= SIDE;
      for (const Cluster &o : s.clusters) {
        if (o.id == i.id || o.id == j->id) continue;
        auto held = [&](const Vec3 &x, double r) { return spring(r + o.radius - norm(apart(x, to_vec3(o.x)))); };
        outcome.energy += std::max(
            0.0, held(body.x, room.radius) - held(to_vec3(i.x), i.radius) - held(to_vec3(j->x), j->radius));
      }
      free = free && outcome.energy <= 1.0e-6 * 0.5 * body.mass * dot(body.v, body.v);
      for (const Taken &t : taken) free = free && norm(apart(body.x, t.centre)) >= t.radius + room.radius;
      if (!free) {
        waiting++;
        return;
      }
      outcome.pieces = 1;
      outcome.first = body.x - to_vec3(i.x);
    }
    taken.push_back(room);
    outcomes[i.id] = outcome;
  }
};

// ---- the same on ranks

struct RankData {
  std::vector<Cluster> clusters;    // owned, ghosts
  std::vector<const double *> x, v;
  std::vector<double> radius, mass;
  Crowd crowd;
};

struct RankedPlan {
  Outcomes outcomes;
  std::map<ClusterID, int> dead;
  int waiting_or_shifted = 0, rounds = 0;

  RankedPlan(const Scene &s, int ranks)
  {
    MadeUp::World world(ranks);
    std::vector<RankData> data(ranks);
    std::map<ClusterID, MadeUp::Owner> owners;
    const double width = SIDE / ranks, cutoff = 2.0 * s.rules.claim;
    for (const Cluster &c : s.clusters) {
      const int rank = std::min(static_cast<int>(c.x[0] / width), ranks - 1);
      owners[c.id] = {rank, static_cast<int>(data[rank].clusters.size())};
      data[rank].clusters.push_back(c);
    }
    for (int rank = 0; rank < ranks; rank++) {
      world.owned[rank] = static_cast<int>(data[rank].clusters.size());
      for (const Cluster &c : s.clusters)
        for (const int image : {-1, 0, 1}) {
          Cluster ghost = c;
          ghost.x[0] += image * SIDE;
          const bool mine = image == 0 && owners[c.id].rank == rank;
          if (mine || ghost.x[0] < rank * width - cutoff || ghost.x[0] > (rank + 1) * width + cutoff) continue;
          ghost.count = ghost.stable = -1;    // the owner tells
          data[rank].clusters.push_back(ghost);
          world.ghosts[rank].push_back(owners[c.id]);
        }
      prepare(data[rank], world.owned[rank], rank * width - cutoff, (rank + 1) * width + cutoff);
    }

    std::vector<Outcomes> found(ranks);
    std::vector<std::vector<ClusterID>> dying(ranks);
    std::vector<int> deferred(ranks), took(ranks);
    MadeUp::run(ranks, [&](int rank) {
      MadeUp::RankHalo halo(world, rank);
      RankData &d = data[rank];
      EventPlan plan(d.crowd, s.rules, halo);
      for (int i = 0; i < d.crowd.nlocal; i++) {
        const BreakPlan wanted = wanted_break(d.clusters[i], s.rules);
        if (wanted.is_event()) plan.propose_break(i, wanted);
      }
      plan.propose_merges(touches(d, s.newton));
      if (plan.any_proposed()) plan.settle();
      for (const Event &e : plan.events()) {
        const Vec3 start = to_vec3(d.crowd.x[e.i]);
        Outcome o;
        o.partner = e.merges() ? d.crowd.id[e.j] : 0;
        o.pieces = e.plan.pieces();
        o.first = e.body.x + (e.breaks() ? e.placement.centres.back() : Vec3{}) - start;
        o.energy = e.energy_born;
        found[rank][d.crowd.id[e.i]] = o;
      }
      for (const int j : plan.dying()) dying[rank].push_back(d.crowd.id[j]);
      deferred[rank] = plan.deferred();
      took[rank] = plan.rounds();
    });
    for (int rank = 0; rank < ranks; rank++) {
      outcomes.insert(found[rank].begin(), found[rank].end());
      for (const ClusterID id : dying[rank]) dead[id]++;
      waiting_or_shifted += deferred[rank];
      rounds = std::max(rounds, took[rank]);
    }
  }

  static void prepare(RankData &d, int nlocal, double lo, double hi)
  {
    Crowd &c = d.crowd;
    c.nlocal = nlocal;
    c.nall = static_cast<int>(d.clusters.size());
    for (const Cluster &cluster : d.clusters) {
      d.x.push_back(cluster.x);
      d.v.push_back(cluster.v);
      d.radius.push_back(cluster.radius);
      d.mass.push_back(cluster.mass);
      c.id.push_back(cluster.id);
      c.kind.push_back(cluster.kind);
      c.size.push_back({cluster.count, cluster.stable, 0});
    }
    c.x = d.x.data();
    c.v = d.v.data();
    c.radius = d.radius.data();
    c.mass = d.mass.data();
    c.lo = {lo, -1.0e-3, 0.0};
    c.hi = {hi, 1.0e-3, SIDE};
    c.walls_around = floor_and_lid;
    c.contact_energy = [&d](int, int j, double r, double distance) { return spring(r + d.radius[j] - distance); };
    c.nearest_image = [&d](int i, ClusterID id) {
      int nearest = -1;
      for (int j = 0; j < d.crowd.nall; j++)
        if (d.crowd.id[j] == id &&
            (nearest < 0 || std::fabs(d.x[j][0] - d.x[i][0]) < std::fabs(d.x[nearest][0] - d.x[i][0])))
          nearest = j;
      return nearest;
    };
  }

  // half lists: with newton on a pair across ranks is on the rank where the other one lies further right
  static std::vector<Touch> touches(const RankData &d, bool newton)
  {
    std::vector<Touch> list;
    for (int i = 0; i < d.crowd.nlocal; i++)
      for (int j = i + 1; j < d.crowd.nall; j++) {
        const bool ghost = j >= d.crowd.nlocal;
        if (norm(to_vec3(d.x[i]) - to_vec3(d.x[j])) >= d.radius[i] + d.radius[j]) continue;
        if (ghost && newton && std::tie(d.x[j][0], d.x[j][2]) < std::tie(d.x[i][0], d.x[i][2])) continue;
        list.push_back({i, j});
      }
    return list;
  }
};

}    // namespace

TEST(EventPlan, IsASerialLoopOverAscendingIDsOnAnyRanks)
{
  ClusterKinds kinds(1);
  kinds.kind(0) = {1.0e-4, 2000.0, 0.5};
  kinds.limits = {3, 400};
  const Lattices lattices(0, 2, 1.6 * kinds.largest_diameter() / kinds.smallest_diameter() + 1.0);
  RandomInputs random(71);
  long breaks = 0, merges = 0, waiting = 0;
  std::map<int, int> rounds[5];
  for (int trial = 0; trial < 1600; trial++) {
    const Scene s = draw(random, kinds, lattices);
    const SerialPlan serial(s);
    const int ranks = 1 + trial % 4;
    const RankedPlan ranked(s, ranks);
    ASSERT_EQ(serial.outcomes.size(), ranked.outcomes.size()) << trial;
    std::map<ClusterID, int> dead;
    for (const auto &[id, expected] : serial.outcomes) {
      const auto found = ranked.outcomes.find(id);
      ASSERT_NE(found, ranked.outcomes.end()) << trial << ": " << id;
      ASSERT_EQ(found->second.partner, expected.partner) << trial << ": " << id;
      ASSERT_EQ(found->second.pieces, expected.pieces) << trial << ": " << id;
      // places on other sides of the box round differently
      ASSERT_LT(norm(found->second.first - expected.first), 1.0e-15) << trial << ": " << id;
      ASSERT_NEAR(found->second.energy, expected.energy, 1.0e-20) << trial << ": " << id;
      if (expected.partner) dead[expected.partner]++;
      (expected.pieces > 1 ? breaks : merges)++;
    }
    ASSERT_EQ(ranked.dead, dead) << trial;
    ASSERT_GE(ranked.waiting_or_shifted, serial.waiting) << trial;
    waiting += serial.waiting;
    rounds[ranks][ranked.rounds]++;
  }
  // the scenes hold all there is to settle
  EXPECT_GT(breaks, 2500);
  EXPECT_GT(merges, 300);
  EXPECT_GT(waiting, 2500);
  for (int ranks = 1; ranks <= 4; ranks++) {
    int crowds = 0, sum = 0;
    for (const auto &[n, times] : rounds[ranks]) {
      crowds += times;
      sum += n * times;
    }
    std::printf("  %d ranks: %d crowds, %.2f rounds in the mean, %d at most\n", ranks, crowds,
                static_cast<double>(sum) / crowds, rounds[ranks].rbegin()->first);
  }
}
