// Where fragments go: sites of a lattice around the parent that overlap nobody.

#ifndef CLUSTERDEM_PLACEMENT_H
#define CLUSTERDEM_PLACEMENT_H

#include "breakup.h"
#include "cluster.h"
#include "vector3.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace ClusterDEM {

// Sites of unit spacing around the origin, nearest first, ties in a fixed order: hexagonal in a
// plane of two axes, face-centred cubic in space.
class Lattice {
 public:
  // axes: the two of the plane, or {-1, -1} for space; reach: outermost distance in spacings
  Lattice(int axis0, int axis1, double reach)
  {
    const bool planar = axis0 >= 0;
    const int m = static_cast<int>(std::ceil(2.0 * reach)) + 1;
    for (int i = -m; i <= m; i++)
      for (int j = -m; j <= m; j++)
        if (planar) {
          Vec3 p = {0.0, 0.0, 0.0};
          p[axis0] = i + 0.5 * j;
          p[axis1] = std::sqrt(0.75) * j;
          // in whole quarters, so that equal distances compare equal
          add(i * i + i * j + j * j, p, reach);
        } else
          for (int k = -m; k <= m; k++) {
            const double h = std::sqrt(0.5);
            add(((i + j) * (i + j) + (j + k) * (j + k) + (i + k) * (i + k)) / 2,
                {h * (i + j), h * (j + k), h * (i + k)}, reach);
          }
    std::sort(sites_.begin(), sites_.end(), [](const Site &a, const Site &b) {
      return std::tie(a.distance2, a.p) < std::tie(b.distance2, b.p);
    });
  }

  std::size_t size() const { return sites_.size(); }
  const Vec3 &site(std::size_t k) const { return sites_[k].p; }

 private:
  struct Site {
    int distance2;    // squared distance in spacings, exact
    Vec3 p;
  };
  std::vector<Site> sites_;

  void add(int distance2, const Vec3 &p, double reach)
  {
    if (distance2 <= reach * reach) sites_.push_back({distance2, p});
  }
};

// The lattice is turned about the given axis by an angle that depends on the parent alone, so that
// no direction is preferred (the golden angle spreads any sequence of tags evenly).
struct Turn {
  double c, s;
  int axis0, axis1;
  Turn(std::int64_t tag, int a0, int a1) : axis0(a0), axis1(a1)
  {
    const double golden = 0.61803398874989484820;
    const double share = golden * static_cast<double>(tag);
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
  bool contains(const Vec3 &p, double radius) const
  {
    for (int k = 0; k < 3; k++)
      if (p[k] - radius < lo[k] || p[k] + radius > hi[k]) return false;
    return true;
  }
};

struct Placement {
  bool found = false;
  bool shifted = false;          // a nearer site was taken by a neighbour
  double reach = 0.0;            // radius of the room that the fragments claim
  std::vector<Vec3> centres;     // relative to the parent's centre of mass, one per piece
};

// Takes the nearest free sites, then moves the whole set so that its centre of mass is the
// parent's, and checks every gap again (gap >= 0). `spacing` in diameters of the n_l pieces.
inline Placement place_fragments(const BreakPlan &plan, const ClusterGeometry &geometry,
                                 const Lattice &lattice, const Turn &turn, double spacing,
                                 double claim, const std::vector<Obstacle> &obstacles,
                                 const Walls &walls)
{
  Placement result;
  const double radius = 0.5 * geometry.diameter(plan.largest());
  // spacing in diameters of the pieces of n_l; one that a remainder was folded into still fits
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

  Vec3 moment = {0.0, 0.0, 0.0};
  double particles = 0.0;
  const int pieces = plan.pieces();
  std::size_t k = 0;
  for (; k < lattice.size() && static_cast<int>(result.centres.size()) < pieces; k++) {
    const Vec3 p = turn(a * lattice.site(k));
    // the claim is about the centre of the whole set, below: beyond twice the claim nothing could fit
    if (norm(p) > 2.0 * claim) return result;
    if (!free(p, radius)) {
      result.shifted = true;
      continue;
    }
    const int n = plan.particles(static_cast<int>(result.centres.size()));
    moment = moment + static_cast<double>(n) * p;
    particles += n;
    result.centres.push_back(p);
  }
  if (static_cast<int>(result.centres.size()) < pieces) return result;

  const Vec3 centre = (1.0 / particles) * moment;
  for (int piece = 0; piece < pieces; piece++) {
    Vec3 &p = result.centres[piece];
    const double r = 0.5 * geometry.diameter(plan.particles(piece));
    p = p - centre;
    if (!free(p, r)) return result;
    result.reach = std::max(result.reach, norm(p) + r);
  }
  result.found = result.reach <= claim;
  return result;
}

// A break that needs more room than one event may claim, or than there is, goes in stages: half as
// many pieces, a quarter … down to two, until a placement is found; they break further at a later check.
inline Placement place_in_stages(BreakPlan &plan, int n, int n_l, int lower_limit,
                                 const ClusterGeometry &geometry, const Lattice &lattice,
                                 const Turn &turn, double spacing, double claim,
                                 const std::vector<Obstacle> &obstacles, const Walls &walls)
{
  Placement placement;
  for (int piece = n_l; piece < n;) {
    plan = plan_breakup(n, piece, lower_limit);
    if (!plan.is_event()) break;
    placement = place_fragments(plan, geometry, lattice, turn, spacing, claim, obstacles, walls);
    if (placement.found || plan.pieces() == 2) break;
    const int fewer = std::max(2, plan.pieces() / 2);
    piece = (n + fewer - 1) / fewer;
  }
  return placement;
}

// A break claims its room; a candidate proceeds only if its tag is the lowest among all candidates
// whose room it overlaps, proceeding or not (no chains): pure data, equal on every rank that sees both.
struct Claim {
  Vec3 centre;
  double radius;
  std::int64_t tag;
};
inline bool yields_to(const Claim &mine, const Claim &other)
{
  if (other.tag >= mine.tag) return false;
  const Vec3 d = mine.centre - other.centre;
  const double reach = mine.radius + other.radius;
  return dot(d, d) < reach * reach;
}

}    // namespace ClusterDEM
#endif
