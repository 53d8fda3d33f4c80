// Where fragments go: sites of a lattice around the parent that overlap nobody.

#ifndef CLUSTERDEM_PLACEMENT_H
#define CLUSTERDEM_PLACEMENT_H

#include "breakup.h"
#include "cluster.h"
#include "vector3.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <vector>

namespace ClusterDEM {

// Sites of unit spacing around the origin, nearest first, ties in a fixed order: hexagonal in a
// plane of two axes, face-centred cubic in space. The origin is a site, or the middle between two
// neighbouring ones: either way every site p has its mirror image -p.
class Lattice {
 public:
  // axes: the two of the plane, or {-1, -1} for space; reach: outermost distance in spacings
  Lattice(int axis0, int axis1, double reach, bool on_a_site = true)
  {
    const int s = on_a_site ? 0 : 1;
    const int m = static_cast<int>(std::ceil(2.0 * reach)) + 2;
    // coordinates in halves, so that squared distances are whole numbers and equal ones compare equal
    for (int i = -m; i <= m; i++)
      for (int j = -m; j <= m; j++)
        if (axis0 >= 0) {
          Vec3 p = {0.0, 0.0, 0.0};
          p[axis0] = 0.5 * (2 * i + j - s);
          p[axis1] = std::sqrt(0.75) * j;
          add((2 * i + j - s) * (2 * i + j - s) + 3 * j * j, 0.25, p, reach);
        } else
          for (int k = -m; k <= m; k++) {
            const int a = 2 * (i + j) - s, b = 2 * (j + k), c = 2 * (i + k) - s;
            const double h = 0.5 * std::sqrt(0.5);
            add(a * a + b * b + c * c, 0.125, {h * a, h * b, h * c}, reach);
          }
    std::sort(sites_.begin(), sites_.end(), [](const Site &a, const Site &b) {
      return std::tie(a.distance2, a.p) < std::tie(b.distance2, b.p);
    });
    for (const Site &site : sites_)
      if (site.p > Vec3{0.0, 0.0, 0.0}) half_.push_back(site.p);
  }

  // about how many sites lie within a reach: area or volume over that of a site
  static double sites_within(bool planar, double reach)
  {
    return planar ? PI * reach * reach / std::sqrt(0.75) : 4.0 / 3.0 * PI * reach * reach * reach * std::sqrt(2.0);
  }

  std::size_t size() const { return sites_.size(); }
  const Vec3 &site(std::size_t k) const { return sites_[k].p; }

  // one of each pair of mirror images
  const std::vector<Vec3> &half() const { return half_; }

 private:
  struct Site {
    int distance2;    // squared distance in whole units, exact
    Vec3 p;
  };
  std::vector<Site> sites_;
  std::vector<Vec3> half_;

  void add(int distance2, double unit, const Vec3 &p, double reach)
  {
    if (unit * distance2 <= reach * reach) sites_.push_back({distance2, p});
  }
};

// an odd number of pieces has one in the middle, an even number none
struct Lattices {
  Lattice odd, even;
  Lattices(int axis0, int axis1, double reach) : odd(axis0, axis1, reach, true), even(axis0, axis1, reach, false)
  {
  }
};

// The lattice is turned about the given axis by an angle that depends on the parent and on the check
// alone: no direction is preferred (the golden angle spreads any sequence of tags evenly), and a break
// that waits for room tries another angle each time.
struct Turn {
  double c, s;
  int axis0, axis1;
  Turn(std::int64_t tag, int a0, int a1, std::int64_t check = 0) : axis0(a0), axis1(a1)
  {
    const double golden = 0.61803398874989484820, plastic = 0.75487766624669276005;
    const double share = golden * static_cast<double>(tag) + plastic * static_cast<double>(check);
    const double angle = 2.0 * PI * (share - std::floor(share));
    c = std::cos(angle);
    s = std::sin(angle);
  }
  Vec3 operator()(const Vec3 &p) const
  {
    Vec3 q = p;
    q[axis0] = c * p[axis0] - s * p[axis1];
    q[axis1] = s * p[axis0] + c * p[axis1];
    return q;
  }
};

// A sphere, or a wall side of the box, that fragments must not touch. Positions relative to the parent.
struct Obstacle {
  Vec3 x;
  double radius;
};
struct Walls {    // room along each axis; infinite where there is no wall
  Vec3 lo, hi;
  std::function<bool(const Vec3 &, double)> inside = nullptr;    // a shape that holds the whole sphere
  bool contains(const Vec3 &p, double radius) const
  {
    for (int k = 0; k < 3; k++)
      if (p[k] - radius < lo[k] || p[k] + radius > hi[k]) return false;
    return !inside || inside(p, radius);
  }
};

struct Placement {
  bool found = false;
  bool shifted = false;         // a nearer site was taken by a neighbour
  double reach = 0.0;           // radius of the room that the fragments claim
  std::vector<Vec3> centres;    // relative to the parent's centre of mass, one per piece
};

// How far around its parent a break of this plan looks for room, at most to its claim: twice the radius
// that its lattice takes when alone. A site of the hexagonal lattice has sqrt(3)/2 of a spacing squared to
// itself, so that n of them fill a disc of radius sqrt(0.2757 n) spacings.
inline double reach_of_break(const BreakPlan &plan, const ClusterGeometry &geometry, double spacing, double claim)
{
  const double r = 0.5 * geometry.diameter(plan.largest());
  const double alone = 2.0 * r * spacing * (std::sqrt(0.2757 * plan.pieces()) + 1.0) + r;
  return std::min(claim, 2.0 * alone);
}

// The room that two halves of a cluster of diameter d need: they lie beside each other, `spacing` of their diameters apart.
inline double room_of_halves(double d, double spacing)
{
  return 0.5 * (spacing + 1.0) * d * std::cbrt(0.5);
}

// Takes the nearest free sites in pairs of mirror images, so that the centre of mass stays where it is;
// a piece of another size sits in the middle, or in the nearest pair. What is left of a shift is taken
// off the whole set, and every gap is checked again (gap >= 0). `spacing` in diameters of the n_l pieces.
inline Placement place_fragments(const BreakPlan &plan, const ClusterGeometry &geometry, const Lattices &lattices,
                                 const Turn &turn, double spacing, double claim,
                                 const std::vector<Obstacle> &obstacles, const Walls &walls)
{
  Placement result;
  const int pieces = plan.pieces();
  const double radius = 0.5 * geometry.diameter(plan.largest());
  // a piece that a remainder was folded into still fits
  const double a = std::max(spacing * geometry.diameter(plan.n), 2.0 * radius);
  auto free = [&](const Vec3 &p, double r) {
    if (!walls.contains(p, r)) return false;
    for (const Obstacle &o : obstacles) {
      const Vec3 d = p - o.x;
      const double gap = r + o.radius;
      if (dot(d, d) < gap * gap) return false;
    }
    return true;
  };

  std::vector<Vec3> centres(pieces);
  // the odd one out is placed first
  auto piece_at = [&](int k) { return plan.last > 0 ? (k == 0 ? pieces - 1 : k - 1) : k; };
  int placed = 0;
  const bool odd = pieces % 2 == 1;
  const Vec3 middle = {0.0, 0.0, 0.0};
  if (odd) {
    if (!free(middle, radius)) return result;
    centres[piece_at(placed++)] = middle;
  }
  for (const Vec3 &site : (odd ? lattices.odd : lattices.even).half()) {
    if (placed == pieces) break;
    const Vec3 p = turn(a * site);
    if (norm(p) > claim + a) return result;    // the shift below is less than a spacing
    const Vec3 q = -1.0 * p;
    if (!free(p, radius) || !free(q, radius)) {
      result.shifted = true;
      continue;
    }
    centres[piece_at(placed++)] = p;
    centres[piece_at(placed++)] = q;
  }
  if (placed < pieces) return result;

  Vec3 moment = {0.0, 0.0, 0.0};
  double particles = 0.0;
  for (int piece = 0; piece < pieces; piece++) {
    moment = moment + static_cast<double>(plan.particles(piece)) * centres[piece];
    particles += plan.particles(piece);
  }
  const Vec3 centre = (1.0 / particles) * moment;
  for (int piece = 0; piece < pieces; piece++) {
    Vec3 &p = centres[piece];
    const double r = 0.5 * geometry.diameter(plan.particles(piece));
    p = p - centre;
    if (!free(p, r)) return result;
    result.reach = std::max(result.reach, norm(p) + r);
  }
  result.found = result.reach <= claim;
  if (result.found) result.centres.swap(centres);
  return result;
}

// A break that needs more room than one event may claim, or than there is, goes in stages: half as
// many pieces, a quarter … down to two, until a placement is found; they break further at a later check.
inline Placement place_in_stages(BreakPlan &plan, int n, int n_l, int lower_limit, const ClusterGeometry &geometry,
                                 const Lattices &lattices, const Turn &turn, double spacing, double claim,
                                 const std::vector<Obstacle> &obstacles, const Walls &walls)
{
  Placement placement;
  for (int piece = n_l; piece < n;) {
    plan = plan_breakup(n, piece, lower_limit);
    if (!plan.is_event()) break;
    placement = place_fragments(plan, geometry, lattices, turn, spacing, claim, obstacles, walls);
    if (placement.found || plan.pieces() == 2) break;
    const int fewer = std::max(2, plan.pieces() / 2);
    piece = (n + fewer - 1) / fewer;
  }
  return placement;
}

}    // namespace ClusterDEM
#endif
