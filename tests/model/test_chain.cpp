// The headers together, as a fix calls them: gas -> drag -> powers -> size -> plan -> fragments, over
// inputs far beyond any real scene. Every number finite, every particle accounted for.

#include "model_testing.h"

#include "model/gas_field.h"
#include "model/merging.h"
#include "model/placement.h"
#include "model/size_law.h"

using namespace ClusterDEM;

TEST(Chain, FiniteAndConservingForAnyInput)
{
  RandomInputs random(70);
  const Lattices lattice(0, 2, 10.0);
  const double inf = std::numeric_limits<double>::infinity();
  const Walls no_walls{{-inf, -inf, -inf}, {inf, inf, inf}};
  int broken = 0;
  for (int k = 0; k < 30000; k++) {
    const ClusterGeometry g = random.geometry();    // 1 um to 5 mm
    const Gas gas = random.gas();
    const SizeLimits limits;
    const int n = random.integer(limits.lo, limits.hi);
    const double mass = g.mass(n), d = g.diameter(n);

    // gas of 0 to 300 m/s and a fluctuation on it
    const Vec3 u =
        random.vector(300.0) + 0.75 * own_fluctuation(1, k, 0, period_index(random.uniform(0.0, 10.0), 0.005));
    const Vec3 v = random.integer(0, 9) ? random.vector(300.0) : u;    // now and then no slip at all
    const Vec3 slip = u - v;

    const auto &entry = drag_laws()[random.integer(0, static_cast<int>(drag_laws().size()) - 1)];
    std::vector<double> p;
    for (const auto &parameter : entry.parameters) p.push_back(random.uniform(0.3, std::min(1.0, parameter.hi)));
    const auto law = entry.make(p.data());
    const double b = cluster_drag_coefficient(*law, gas, d, g.d_p, n, random.integer(0, 2) * 0.5, norm(slip));
    ASSERT_TRUE(std::isfinite(b) && b >= 0.0) << entry.name;
    const double factor = exponential_factor(random.log_uniform(1.0e-9, 1.0) * b / mass);
    ASSERT_TRUE(factor >= 0.0 && factor <= 1.0);

    const Vec3 drag_p = drag_coefficient(*law, gas, g.d_p, norm(slip)) * slip;
    const double st = n_st(drag_p, u, g.particle_mass());
    const double cc = n_cc(random.vector(1.0)[0], mass, random.uniform(0.0, 1.0));
    const double u_mf = umf_wen_yu(g.d_p, g.rho_p, gas, gravity);
    ASSERT_TRUE(std::isfinite(u_mf) && u_mf >= 0.0);
    const double mf = n_smf(random.coin() ? NsmfReading::EMMS : NsmfReading::PAPER, u_mf, std::fabs(v[2]),
                            random.uniform(0.0, 0.9), gravity);
    ASSERT_TRUE(std::isfinite(st) && std::isfinite(cc) && std::isfinite(mf));
    const double e_in = st + cc - mf;
    const double K = random.coin() ? random.log_uniform(1.0e-6, 1.0e6)
                                   : k_emms(g.d_p, random.uniform(0.0, 10.0), u_mf, 0.5, gravity);
    ASSERT_TRUE(std::isfinite(K));

    // half as the powers have it, half with an energy that makes l about as large as the cluster
    const StableSize stable = stable_size(K, random.coin() ? e_in : K / (d * random.uniform(0.1, 1.2)), g, limits);
    ASSERT_TRUE(stable.n >= limits.lo && stable.n <= limits.hi);
    ASSERT_TRUE(stable.l >= g.diameter(limits.lo) && stable.l <= g.diameter(limits.hi));
    if (!breaks(d, stable.l, 0.26)) continue;

    const BreakPlan wanted = plan_breakup(n, stable.n, limits.lo);
    // with h = 0.26 a cluster that breaks holds at least 1.26^3 = 2 n_l particles: it is always an event
    ASSERT_TRUE(wanted.is_event()) << n << " " << stable.n;
    BreakPlan plan;
    const Placement placed = place_in_stages(plan, n, stable.n, limits.lo, g, lattice, Turn(k, 0, 2), 2.0,
                                             1.6 * g.diameter(limits.hi), {}, no_walls);
    ASSERT_TRUE(placed.found) << n << " " << stable.n;    // alone, any break finds room within the default claim
    int particles = 0;
    double fragments = 0.0;
    for (int piece = 0; piece < plan.pieces(); piece++) {
      ASSERT_GE(plan.particles(piece), limits.lo);
      ASSERT_TRUE(finite(placed.centres[piece]));
      particles += plan.particles(piece);
      fragments += g.mass(plan.particles(piece));
    }
    ASSERT_EQ(particles, n);
    // masses of up to 666 fragments, summed one after another
    ASSERT_TRUE(relatively_near(fragments, mass, 666.0 * EPS));
    broken++;
  }
  EXPECT_GT(broken, 3000);    // or the second half was not tested
}

TEST(Chain, FragmentsMergedBackAreTheParent)
{
  // break, then merge all the fragments again: count, mass, place and momentum are the parent's
  RandomInputs random(71);
  const Lattices lattice(0, 2, 16.0);
  const double inf = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 1000; k++) {
    const int n = random.integer(6, 2000);
    const BreakPlan plan = plan_breakup(n, random.integer(3, n / 2), 3);
    const Placement placed = place_fragments(plan, paper_geometry, lattice, Turn(k, 0, 2), 2.0, 1.0, {},
                                             {{-inf, -inf, -inf}, {inf, inf, inf}});
    ASSERT_TRUE(placed.found);
    const Vec3 x = random.vector(0.3), v = random.vector(10.0);
    Body whole{};
    double lost = 0.0;
    for (int piece = 0; piece < plan.pieces(); piece++) {
      const Body fragment{paper_geometry.mass(plan.particles(piece)), x + placed.centres[piece], v};
      if (piece > 0) lost += energy_lost(whole, fragment);
      whole = piece > 0 ? combine(whole, fragment) : fragment;
    }
    const auto count = paper_geometry.count_from_mass(whole.mass);
    ASSERT_TRUE(count.whole);
    ASSERT_EQ(count.n, n);
    // up to 666 merges, each rounding positions of 0.3 m and velocities of 10 m/s a few times
    ASSERT_LE(norm(whole.x - x), 4.0 * 666.0 * EPS * 0.6);
    ASSERT_LE(norm(whole.v - v), 4.0 * 666.0 * EPS * 18.0);
    // all moved alike: nothing is lost but the square of that rounding
    ASSERT_LE(lost, 1.0e-20 * whole.mass * 300.0);
  }
}
