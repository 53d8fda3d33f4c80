// Where fragments go: lattices, turns, free room, stages.

#include "model_testing.h"

#include "model/placement.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

using namespace ClusterDEM;

namespace {

const double inf = std::numeric_limits<double>::infinity();
const Walls no_walls{{-inf, -inf, -inf}, {inf, inf, inf}};

double radius_of(const ClusterGeometry &g, const BreakPlan &plan, int piece)
{
  return 0.5 * g.diameter(plan.particles(piece));
}

// everything that a placement promises
void check(const Placement &placed, const BreakPlan &plan, const ClusterGeometry &g, double spacing, double claim,
           const std::vector<Obstacle> &obstacles, const Walls &walls, bool planar)
{
  ASSERT_EQ(static_cast<int>(placed.centres.size()), plan.pieces());
  const double step = std::max(spacing * g.diameter(plan.n), g.diameter(plan.largest()));
  // gaps between siblings are one lattice step less two radii; where the step is exactly a diameter the
  // positions round: a few units in the last place of the outermost one
  const double rounding = 8.0 * EPS * (placed.reach + step);
  Vec3 moment = {0.0, 0.0, 0.0};
  double particles = 0.0, reach = 0.0;
  for (int i = 0; i < plan.pieces(); i++) {
    const Vec3 &p = placed.centres[i];
    const double r = radius_of(g, plan, i);
    ASSERT_TRUE(finite(p));
    for (int j = 0; j < i; j++)
      ASSERT_GE(norm(p - placed.centres[j]), std::max(r + radius_of(g, plan, j), step) - rounding)
          << i << " " << j;
    // obstacles and walls were tested at the very positions that came back: one rounding of a root
    for (const Obstacle &o : obstacles) ASSERT_GE(norm(p - o.x), (r + o.radius) * (1.0 - 4.0 * EPS));
    for (int k = 0; k < 3; k++) {
      ASSERT_GE(p[k] - r, walls.lo[k]);
      ASSERT_LE(p[k] + r, walls.hi[k]);
    }
    if (planar) { ASSERT_EQ(p[1], 0.0); }    // not moved off the plane by a bit
    reach = std::max(reach, norm(p) + r);
    moment = moment + static_cast<double>(plan.particles(i)) * p;
    particles += plan.particles(i);
  }
  ASSERT_EQ(placed.reach, reach);
  ASSERT_LE(placed.reach, claim);
  ASSERT_LE(norm(moment) / particles, 1.0e-12 * step);    // the centre of mass is the parent's
}

}    // namespace

// ---- Lattice ----

TEST(Lattice, HexagonalShells)
{
  // 1, 6, 6, 6, 12, 6, 6, 12 neighbours at 0, 1, sqrt 3, 2, sqrt 7, 3, sqrt 12, sqrt 13
  const std::vector<std::pair<int, int>> shells = {{0, 1},  {1, 6}, {3, 6},  {4, 6},
                                                   {7, 12}, {9, 6}, {12, 6}, {13, 12}};
  const Lattice lattice(0, 2, std::sqrt(13.5));
  std::size_t k = 0;
  for (const auto &[distance2, count] : shells)
    for (int i = 0; i < count; i++, k++) {
      ASSERT_LT(k, lattice.size());
      const Vec3 &p = lattice.site(k);
      // coordinates of a few units, squared: far below 1e-13
      ASSERT_NEAR(dot(p, p), distance2, 1.0e-13) << k;
      ASSERT_EQ(p[1], 0.0);
    }
  EXPECT_EQ(lattice.size(), k);
}

TEST(Lattice, FaceCentredCubicShells)
{
  // the coordination shells of fcc: 12, 6, 24, 12, 24, 8, 48, 6 at sqrt 1, 2, 3, 4, 5, 6, 7, 8
  const int shells[] = {1, 12, 6, 24, 12, 24, 8, 48, 6};
  const Lattice lattice(-1, -1, std::sqrt(8.5));
  std::size_t k = 0;
  for (int distance2 = 0; distance2 <= 8; distance2++)
    for (int i = 0; i < shells[distance2]; i++, k++) {
      ASSERT_LT(k, lattice.size());
      ASSERT_NEAR(dot(lattice.site(k), lattice.site(k)), distance2, 1.0e-13) << k;
    }
  EXPECT_EQ(lattice.size(), k);
}

TEST(Lattice, UnitSpacingAndFixedOrder)
{
  for (int axis0 : {0, -1}) {
    const Lattice lattice(axis0, axis0 < 0 ? -1 : 2, 4.0), again(axis0, axis0 < 0 ? -1 : 2, 4.0);
    ASSERT_EQ(lattice.size(), again.size());
    double nearest = inf;
    for (std::size_t i = 0; i < lattice.size(); i++) {
      ASSERT_EQ(lattice.site(i), again.site(i));
      for (std::size_t j = 0; j < i; j++) nearest = std::min(nearest, norm(lattice.site(i) - lattice.site(j)));
    }
    EXPECT_NEAR(nearest, 1.0, 1.0e-14);    // coordinates up to 4 round
  }
}

TEST(Lattice, SitesWithinAReach)
{
  // what is refused before it fills the memory: the estimate errs by the sites along the border alone
  for (bool planar : {true, false})
    for (double reach : {10.0, 30.0}) {
      const Lattice lattice(planar ? 0 : -1, planar ? 2 : -1, reach);
      EXPECT_NEAR(Lattice::sites_within(planar, reach) / lattice.size(), 1.0, 0.3 / reach) << planar << reach;
    }
}

TEST(Lattice, BetweenTwoSites)
{
  // shells about the middle of a bond, in squared spacings: 1/4, 3/4, 7/4 … in a plane; 1/4, 3/4 … in space
  for (int axis0 : {0, -1}) {
    const Lattice lattice(axis0, axis0 < 0 ? -1 : 2, 4.0, false);
    std::map<long, int> shells;
    for (std::size_t k = 0; k < lattice.size(); k++)
      shells[std::lround(4.0 * dot(lattice.site(k), lattice.site(k)))]++;
    EXPECT_EQ(shells.begin()->first, 1);
    EXPECT_EQ(shells.begin()->second, 2);
    EXPECT_EQ(shells[3], axis0 < 0 ? 4 : 2);
    if (axis0 == 0) { EXPECT_EQ(shells[7], 4); }
  }
}

TEST(Lattice, EverySiteHasItsMirrorImage)
{
  for (int axis0 : {0, -1})
    for (bool on_a_site : {true, false}) {
      const Lattice lattice(axis0, axis0 < 0 ? -1 : 2, 4.0, on_a_site);
      std::set<Vec3> all;
      for (std::size_t k = 0; k < lattice.size(); k++) all.insert(lattice.site(k));
      for (const Vec3 &p : lattice.half()) EXPECT_EQ(all.count(Vec3{0.0, 0.0, 0.0} - p), 1u);
      EXPECT_EQ(2 * lattice.half().size() + (on_a_site ? 1 : 0), lattice.size());
    }
}

TEST(Lattice, LargeReachIsComplete)
{
  // as many sites as the area (2/sqrt 3 per unit area) or the volume (sqrt 2 per unit volume) holds; the
  // rim is one spacing wide and counts for less than its area or volume
  for (double reach : {5.0, 13.7, 20.0}) {
    const double plane = static_cast<double>(Lattice(0, 2, reach).size()),
                 disc = 2.0 / std::sqrt(3.0) * PI * reach * reach;
    EXPECT_NEAR(plane / disc, 1.0, 1.0 / reach) << reach;
  }
  const double space = static_cast<double>(Lattice(-1, -1, 9.0).size()),
               ball = std::sqrt(2.0) * 4.0 / 3.0 * PI * 729.0;
  EXPECT_NEAR(space / ball, 1.0, 1.0 / 9.0);
}

// ---- Turn ----

TEST(Turn, KeepsDistancesAndTheAxis)
{
  RandomInputs random(60);
  for (int k = 0; k < 10000; k++) {
    const Turn turn(static_cast<std::int64_t>(random.word() >> 1), 0, 2);    // any tag of 63 bits
    const Vec3 p = random.vector(1.0), q = turn(p);
    ASSERT_EQ(q[1], p[1]);
    ASSERT_NEAR(norm(q), norm(p), 8.0 * EPS);    // |p| <= sqrt 3; sine and cosine round
    // a rotation, not a mirror: the area between a vector and its image keeps its sign
    const Vec3 x = turn({1.0, 0.0, 0.0}), z = turn({0.0, 0.0, 1.0});
    ASSERT_NEAR(x[0] * z[2] - x[2] * z[0], 1.0, 8.0 * EPS);
  }
}

TEST(Turn, TagsSpreadOverTheCircle)
{
  // the golden angle: of any N consecutive tags the widest gap is below twice the mean gap (1 + 2/sqrt 5
  // = 1.894 at worst)
  for (int first : {0, 1, 17, 1000000}) {
    for (int n : {5, 6, 13, 100, 987}) {
      std::vector<double> angles;
      for (int tag = first; tag < first + n; tag++) {
        const Turn turn(tag, 0, 2);
        angles.push_back(std::atan2(turn.s, turn.c) / (2.0 * PI));
      }
      std::sort(angles.begin(), angles.end());
      double widest = angles.front() + 1.0 - angles.back();
      for (int k = 1; k < n; k++) widest = std::max(widest, angles[k] - angles[k - 1]);
      EXPECT_LT(widest, 1.9 / n) << first << " " << n;
    }
  }
}

// ---- place_fragments ----

TEST(PlaceFragments, TwoHalvesByHand)
{
  // one lattice step apart, the parent's centre half way
  const BreakPlan plan = plan_breakup(400, 200, 3);
  const double d = paper_geometry.diameter(200);
  const Placement placed =
      place_fragments(plan, paper_geometry, Lattices(0, 2, 5.0), Turn(1, 0, 2), 2.0, 1.0, {}, no_walls);
  ASSERT_TRUE(placed.found);
  EXPECT_FALSE(placed.shifted);
  EXPECT_TRUE(relatively_near(norm(placed.centres[0] - placed.centres[1]), 2.0 * d, 8.0 * EPS));
  EXPECT_TRUE(relatively_near(placed.reach, 1.5 * d, 8.0 * EPS));
}

TEST(PlaceFragments, SevenAndThirteenEqualPiecesFillTheFirstShell)
{
  // one in the middle, all neighbours around it: reach = one step + one radius
  for (bool planar : {true, false}) {
    const BreakPlan plan = planar ? plan_breakup(700, 100, 3) : plan_breakup(1300, 100, 3);
    const double d = paper_geometry.diameter(100);
    const Lattices lattice = planar ? Lattices(0, 2, 5.0) : Lattices(-1, -1, 5.0);
    const Placement placed =
        place_fragments(plan, paper_geometry, lattice, Turn(5, 0, planar ? 2 : 1), 2.0, 1.0, {}, no_walls);
    ASSERT_TRUE(placed.found);
    EXPECT_TRUE(relatively_near(placed.reach, 2.5 * d, 16.0 * EPS));
    EXPECT_LE(norm(placed.centres[0]), 1.0e-14 * d);    // rounding of the mean of a symmetric shell
  }
}

TEST(ReachOfBreak, ByHand)
{
  // 4 pieces: a radius of sqrt(1.1028) + 1 spacings of 2 diameters, a half for the outermost, all of it twice
  const BreakPlan plan = plan_breakup(400, 100, 3);
  const double d = paper_geometry.diameter(100);
  const double alone = 2.0 * (std::sqrt(1.1028) + 1.0) + 0.5;
  EXPECT_TRUE(relatively_near(reach_of_break(plan, paper_geometry, 2.0, 1.0), 2.0 * alone * d, 16.0 * EPS));
  EXPECT_EQ(reach_of_break(plan, paper_geometry, 2.0, 3.0 * d), 3.0 * d);    // never beyond the claim
  // the larger piece counts: 202 particles are one piece of 100 and one of 102
  const BreakPlan folded = plan_breakup(202, 100, 3);
  const BreakPlan equal = plan_breakup(204, 102, 3);
  EXPECT_EQ(reach_of_break(folded, paper_geometry, 2.0, 1.0), reach_of_break(equal, paper_geometry, 2.0, 1.0));
}

TEST(ReachOfBreak, HoldsTheLatticeOfAnyPlan)
{
  // the estimate must not fall short of what an undisturbed break takes, or neighbours would go unseen
  const Lattices lattice(0, 2, 20.0);
  for (int n = 6; n <= 2000; n += 13)
    for (int n_l = 3; 2 * n_l <= n; n_l += (n_l < 20 ? 1 : 23)) {
      const BreakPlan plan = plan_breakup(n, n_l, 3);
      if (!plan.is_event()) continue;
      const double reach = reach_of_break(plan, paper_geometry, 2.0, 1.0);
      const Placement placed =
          place_fragments(plan, paper_geometry, lattice, Turn(n, 0, 2), 2.0, reach, {}, no_walls);
      ASSERT_TRUE(placed.found) << n << " " << n_l;
      ASSERT_LT(placed.reach, 0.75 * reach) << n << " " << n_l;    // room left to step aside
    }
}

TEST(PlaceFragments, RoomOfTheLargestBreak)
{
  // 666 threes claim about 4.9 mm in a plane; the rim of the disc is half a step (0.18 mm) to either side
  const BreakPlan plan = plan_breakup(1998, 3, 3);
  const Placement placed =
      place_fragments(plan, paper_geometry, Lattices(0, 2, 16.0), Turn(1, 0, 2), 2.0, 1.0, {}, no_walls);
  ASSERT_TRUE(placed.found);
  EXPECT_NEAR(placed.reach, 4.9e-3, 0.18e-3);
  check(placed, plan, paper_geometry, 2.0, 1.0, {}, no_walls, true);
}

TEST(PlaceFragments, AnyBreakAmongAnyNeighbours)
{
  RandomInputs random(61);
  const Lattices plane(0, 2, 14.0), space(-1, -1, 6.0);
  int found = 0, shifted = 0, walled = 0, of_many = 0;
  for (int trial = 0; trial < 6000; trial++) {
    const ClusterGeometry g = random.geometry();
    const bool planar = random.coin();
    const int n = random.integer(6, 2000);
    const BreakPlan plan = plan_breakup(n, std::max(3, n / random.integer(2, random.coin() ? 8 : 100)), 3);
    if (!plan.is_event()) continue;
    const double spacing = random.integer(0, 4) ? random.uniform(1.0, 3.0) : 1.0;
    const double d = g.diameter(plan.largest());
    const double claim = d * spacing * random.uniform(1.0, 12.0);

    // neighbours outside the parent, as a real one has them, and now and then anywhere
    std::vector<Obstacle> obstacles;
    const double parent = 0.5 * g.diameter(n);
    for (int k = random.integer(0, 12); k > 0; k--) {
      const double r = 0.5 * g.diameter(random.integer(3, 2000));
      Vec3 x = random.vector(1.0);
      if (planar) x[1] = 0.0;
      const double length = norm(x);
      if (length == 0.0) continue;
      const double away = random.integer(0, 9) ? parent + r + random.uniform(0.0, 4.0) * parent
                                               : random.uniform(0.0, parent);
      obstacles.push_back({(away / length) * x, r});
    }
    Walls walls = no_walls;
    if (random.integer(0, 3) == 0) {
      const int axis = planar ? 2 * random.integer(0, 1) : random.integer(0, 2);
      (random.coin() ? walls.hi[axis] : walls.lo[axis]) = 0.0;
      if (walls.hi[axis] == 0.0) walls.hi[axis] = parent * random.uniform(1.0, 3.0);
      else walls.lo[axis] = -parent * random.uniform(1.0, 3.0);
    }
    const Turn turn(random.integer(1, 1000000), 0, planar ? 2 : 1);
    const Lattices &lattice = planar ? plane : space;
    const Placement placed = place_fragments(plan, g, lattice, turn, spacing, claim, obstacles, walls);

    // the same again, neighbours in another order: the same bits
    std::reverse(obstacles.begin(), obstacles.end());
    const Placement again = place_fragments(plan, g, lattice, turn, spacing, claim, obstacles, walls);
    ASSERT_EQ(placed.found, again.found);
    ASSERT_EQ(placed.shifted, again.shifted);
    ASSERT_EQ(placed.reach, again.reach);
    ASSERT_EQ(placed.centres, again.centres);
    ASSERT_FALSE(std::isnan(placed.reach));

    if (!placed.found) continue;
    check(placed, plan, g, spacing, claim, obstacles, walls, planar);
    if (HasFatalFailure()) return;
    found++;
    if (placed.shifted) shifted++;
    if (walls.lo != no_walls.lo || walls.hi != no_walls.hi) walled++;
    if (plan.pieces() > 20) of_many++;
  }
  // a test that found nothing would prove nothing
  EXPECT_GT(found, 1500);
  EXPECT_GT(shifted, 300);
  EXPECT_GT(walled, 200);
  EXPECT_GT(of_many, 100);
}

TEST(PlaceFragments, WithoutNeighboursNothingIsShifted)
{
  RandomInputs random(62);
  const Lattices lattice(0, 2, 16.0);
  for (int k = 0; k < 500; k++) {
    const int n = random.integer(6, 2000);
    const BreakPlan plan = plan_breakup(n, random.integer(3, n / 2), 3);
    const Placement placed = place_fragments(plan, paper_geometry, lattice, Turn(k, 0, 2), 2.0, 1.0, {}, no_walls);
    ASSERT_TRUE(placed.found);
    ASSERT_FALSE(placed.shifted);
    check(placed, plan, paper_geometry, 2.0, 1.0, {}, no_walls, true);
    if (HasFatalFailure()) return;
    // as tight as the plane allows: pieces on a disc of their own area, and a rim of one and a half steps
    const double step = 2.0 * paper_geometry.diameter(plan.largest());
    ASSERT_LE(placed.reach, step * (std::sqrt(std::sqrt(0.75) * plan.pieces() / PI) + 1.5));
  }
}

TEST(PlaceFragments, NoRoomIsNotFound)
{
  const BreakPlan plan = plan_breakup(400, 100, 3);
  const Lattices lattice(0, 2, 10.0);
  const Turn turn(1, 0, 2);
  // a claim below the parent, a neighbour over everything, walls closer than a piece, a lattice too small
  EXPECT_FALSE(place_fragments(plan, paper_geometry, lattice, turn, 2.0, 0.5e-3, {}, no_walls).found);
  EXPECT_FALSE(
      place_fragments(plan, paper_geometry, lattice, turn, 2.0, 5.0e-3, {{{0.0, 0.0, 0.0}, 1.0}}, no_walls).found);
  EXPECT_FALSE(place_fragments(plan, paper_geometry, lattice, turn, 2.0, 5.0e-3, {},
                               {{-1.0e-4, -inf, -inf}, {1.0e-4, inf, inf}})
                   .found);
  EXPECT_FALSE(place_fragments(plan, paper_geometry, Lattices(0, 2, 0.5), turn, 2.0, 1.0, {}, no_walls).found);
  // and with room for it, the same break is
  EXPECT_TRUE(place_fragments(plan, paper_geometry, lattice, turn, 2.0, 5.0e-3, {}, no_walls).found);
}

TEST(PlaceFragments, ShiftIsReported)
{
  // a small neighbour on a site of the first shell
  const BreakPlan plan = plan_breakup(700, 100, 3);
  const Lattices lattice(0, 2, 10.0);
  const Turn turn(7, 0, 2);
  const double step = 2.0 * paper_geometry.diameter(100);
  const std::vector<Obstacle> on_site = {{turn(step * lattice.odd.half()[0]), 1.0e-6}};
  const Placement placed = place_fragments(plan, paper_geometry, lattice, turn, 2.0, 1.0, on_site, no_walls);
  ASSERT_TRUE(placed.found);
  EXPECT_TRUE(placed.shifted);
  check(placed, plan, paper_geometry, 2.0, 1.0, on_site, no_walls, true);
}

// ---- place_in_stages ----

TEST(PlaceInStages, TakesTheFinestThatFits)
{
  RandomInputs random(63);
  const Lattices lattice(0, 2, 40.0);
  int staged = 0, fine = 0;
  for (int trial = 0; trial < 400; trial++) {
    const int n = random.integer(6, 2000);
    const int n_l = std::min(n / 2, static_cast<int>(random.log_uniform(3.0, 400.0)));
    const Turn turn(trial, 0, 2);
    const double claim = random.uniform(1.0e-3, 4.0e-3);
    std::vector<Obstacle> obstacles;
    for (int k = random.integer(0, 3); k > 0; k--) {
      const double angle = random.uniform(0.0, 2.0 * PI),
                   away = 0.5 * paper_geometry.diameter(n) + random.uniform(0.5e-3, 3.0e-3);
      obstacles.push_back({{away * std::cos(angle), 0.0, away * std::sin(angle)}, 0.5e-3});
    }
    BreakPlan plan;
    const Placement placed =
        place_in_stages(plan, n, n_l, 3, paper_geometry, lattice, turn, 2.0, claim, obstacles, no_walls);
    // the rule, by itself: pieces of n_l, then half as many equal ones … down to two, until one fits
    bool expected = false;
    for (int piece = n_l; piece < n && !expected;) {
      const BreakPlan alone = plan_breakup(n, piece, 3);
      if (!alone.is_event()) break;
      const Placement single =
          place_fragments(alone, paper_geometry, lattice, turn, 2.0, claim, obstacles, no_walls);
      if (!single.found) {
        if (alone.pieces() == 2) break;
        const int fewer = std::max(2, alone.pieces() / 2);
        piece = n / fewer + (n % fewer > 0 ? 1 : 0);
        continue;
      }
      expected = true;
      ASSERT_EQ(plan.n, piece);
      ASSERT_EQ(plan.whole, alone.whole);
      ASSERT_EQ(plan.last, alone.last);
      ASSERT_EQ(placed.centres, single.centres);
      (piece == n_l ? fine : staged)++;
    }
    ASSERT_EQ(placed.found, expected);
    if (!placed.found) continue;
    check(placed, plan, paper_geometry, 2.0, claim, obstacles, no_walls, true);
    if (HasFatalFailure()) return;
    long sum = 0;
    for (int piece = 0; piece < plan.pieces(); piece++) sum += plan.particles(piece);
    ASSERT_EQ(sum, n);
    ASSERT_GT(plan.pieces(), 1);
  }
  EXPECT_GT(staged, 50);
  EXPECT_GT(fine, 50);
}

TEST(PlaceInStages, TheLargestBreakInASmallClaim)
{
  // 2000 into threes wants 4.9 mm: within 2.5 mm it comes apart in fewer, coarser ones
  BreakPlan plan;
  const Placement placed = place_in_stages(plan, 2000, 3, 3, paper_geometry, Lattices(0, 2, 16.0), Turn(1, 0, 2),
                                           2.0, 2.54e-3, {}, no_walls);
  ASSERT_TRUE(placed.found);
  EXPECT_GT(plan.n, 3);
  check(placed, plan, paper_geometry, 2.0, 2.54e-3, {}, no_walls, true);
}

TEST(PlaceInStages, AloneEveryBreakFindsRoomWithinTheDefaultClaim)
{
  // the fix claims 1.6 largest diameters unless told; a cluster that could never break would stay for ever
  const double claim = 1.6 * paper_geometry.diameter(2000);
  const Lattices lattice(0, 2, 9.0);
  for (int n = 6; n <= 2000; n += (n < 1000 ? 17 : 9))
    for (int n_l = 3; 2 * n_l <= n; n_l += (n_l < 20 ? 1 : 23)) {
      BreakPlan plan;
      const Placement placed =
          place_in_stages(plan, n, n_l, 3, paper_geometry, lattice, Turn(n, 0, 2), 2.0, claim, {}, no_walls);
      ASSERT_TRUE(placed.found) << n << " " << n_l;
    }
}

TEST(PlaceInStages, NothingToBreak)
{
  const Lattices lattice(0, 2, 5.0);
  for (int n_l : {0, 5, 6, 2000}) {    // no size given; a remainder that folds; whole; larger
    BreakPlan plan;
    EXPECT_FALSE(place_in_stages(plan, n_l == 5 ? 7 : 6, n_l, 3, paper_geometry, lattice, Turn(1, 0, 2), 2.0, 1.0,
                                 {}, no_walls)
                     .found)
        << n_l;
    EXPECT_FALSE(plan.is_event()) << n_l;
  }
}
