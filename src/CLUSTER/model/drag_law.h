// Drag laws. Each law is one struct that gives C_D Re as a function of the Reynolds number
// Re = |u_g - V| d / nu_g on the nominal (volume-equivalent) diameter; the product stays finite
// where Re -> 0. A law is added by one struct and one line in drag_laws().

#ifndef CLUSTERDEM_DRAG_LAW_H
#define CLUSTERDEM_DRAG_LAW_H

#include "cluster.h"
#include "vector3.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ClusterDEM {

struct DragLaw {
  virtual ~DragLaw() = default;
  virtual double cd_re(double re) const = 0;    // drag coefficient times Reynolds number
  // at another voidage than the law's own, for laws that have one
  virtual double cd_re(double re, double) const { return cd_re(re); }
};

// a law of many particles: what holds at any voidage eps, and a voidage
struct VoidageLaw : DragLaw {
  const double voidage;
  explicit VoidageLaw(double eps) : voidage(eps) {}
  using DragLaw::cd_re;
  double cd_re(double re) const override { return cd_re(re, voidage); }
};

// no drag at all
struct NoDrag : DragLaw {
  double cd_re(double) const override { return 0.0; }
};

// Stokes (1851): C_D = 24/Re
struct StokesDrag : DragLaw {
  double cd_re(double) const override { return 24.0; }
};

// Schiller & Naumann (1933): C_D = 24/Re (1 + 0.15 Re^0.687), at least 0.44 (Re > 1000)
struct SchillerNaumannDrag : DragLaw {
  double cd_re(double re) const override { return std::max(24.0 * (1.0 + 0.15 * std::pow(re, 0.687)), 0.44 * re); }
};

// Wen & Yu (1966): the single-sphere drag at Re_eps = eps Re, times eps^-3.65 per particle
// (on the superficial slip eps |u - V|). eps = 1 is one sphere.
struct WenYuDrag : VoidageLaw {
  using VoidageLaw::cd_re;
  using VoidageLaw::VoidageLaw;
  double cd_re(double re, double eps) const override
  {
    return SchillerNaumannDrag().cd_re(eps * re) * std::pow(eps, -2.65);
  }
};

// Gidaspow (1994): Ergun (1952) in a dense bed, eps < 0.8, Wen & Yu above. From Ergun's pressure drop
// 150 (1-eps)^2 mu U/(eps^3 d^2) + 1.75 (1-eps) rho U^2/(eps^3 d), U = eps |u - V|, shared among the particles:
// C_D Re = 200 (1-eps)/eps + 7/3 Re. Discontinuous at eps = 0.8, as published.
struct GidaspowDrag : VoidageLaw {
  using VoidageLaw::cd_re;
  using VoidageLaw::VoidageLaw;
  double cd_re(double re, double eps) const override
  {
    if (eps >= 0.8) return WenYuDrag(eps).cd_re(re);
    return 200.0 * (1.0 - eps) / eps + 7.0 / 3.0 * re;
  }
};

// Di Felice (1994): Dalla Valle's C_D = (0.63 + 4.8/sqrt(Re_eps))^2, Re_eps = eps Re, on the
// superficial slip, times eps^-beta with beta = 3.7 - 0.65 exp(-(1.5 - log10 Re_eps)^2 / 2)
struct DiFeliceDrag : VoidageLaw {
  using VoidageLaw::cd_re;
  using VoidageLaw::VoidageLaw;
  double cd_re(double re, double eps) const override
  {
    const double re_eps = eps * re;
    if (re_eps <= 0.0) return 4.8 * 4.8 * std::pow(eps, 1.0 - 3.7);
    const double root = 0.63 * std::sqrt(re_eps) + 4.8;    // C_D Re_eps = root^2
    const double x = 1.5 - std::log10(re_eps);
    const double beta = 3.7 - 0.65 * std::exp(-0.5 * x * x);
    return root * root * std::pow(eps, 1.0 - beta);
  }
};

// Tran-Cong, Gay & Michaelides (2004), irregular agglomerates, Re on the nominal diameter:
// C_D = 24/Re r [1 + 0.15/sqrt(c) (r Re)^0.687] + 0.42 r^2 / (sqrt(c) [1 + 4.25e4 (r Re)^-1.16]),
// r = d_A/d_n, c = circularity; fitted for 0.15 < Re < 1500, 0.8 < r < 1.5, 0.4 < c < 1.
// The first factor r was recalled, not read in the primary source: it lives on this line alone.
struct TranCongDrag : DragLaw {
  double root_c, r;
  TranCongDrag(double circularity, double dA_dn) : root_c(std::sqrt(circularity)), r(dA_dn) {}
  double cd_re(double re) const override
  {
    // x^0.687 and x^1.16 by one logarithm: this law is evaluated for every cluster at every step
    const double log_x = std::log(r * re);    // -inf at rest: both powers are 0
    const double viscous = 24.0 * r * (1.0 + 0.15 / root_c * std::exp(0.687 * log_x));
    const double p = std::exp(1.16 * log_x);
    const double share = std::isinf(p) ? 1.0 : p / (p + 4.25e4);    // 1/(1 + 4.25e4 x^-1.16)
    return viscous + 0.42 * r * r * re / root_c * share;
  }
};

// one line per law: its name, its parameters with the range each must lie in, how to make it
struct DragParameter {
  const char *name;
  double lo, hi;           // lo < value <= hi
  bool voidage = false;    // may be that of cells, too
};
struct DragLawEntry {
  const char *name;
  std::vector<DragParameter> parameters;
  std::function<std::unique_ptr<DragLaw>(const double *)> make;
};

inline const std::vector<DragLawEntry> &drag_laws()
{
  static const std::vector<DragLawEntry> laws = {
      {"trancong",
       {{"c", 0.0, 1.0}, {"dA/dn", 0.0, 10.0}},
       [](const double *p) { return std::make_unique<TranCongDrag>(p[0], p[1]); }},
      {"schiller/naumann", {}, [](const double *) { return std::make_unique<SchillerNaumannDrag>(); }},
      {"stokes", {}, [](const double *) { return std::make_unique<StokesDrag>(); }},
      {"wen/yu", {{"voidage", 0.0, 1.0, true}}, [](const double *p) { return std::make_unique<WenYuDrag>(p[0]); }},
      {"gidaspow",
       {{"voidage", 0.0, 1.0, true}},
       [](const double *p) { return std::make_unique<GidaspowDrag>(p[0]); }},
      {"difelice",
       {{"voidage", 0.0, 1.0, true}},
       [](const double *p) { return std::make_unique<DiFeliceDrag>(p[0]); }},
      {"none", {}, [](const double *) { return std::make_unique<NoDrag>(); }},
  };
  return laws;
}

// the gas as the drag sees it
struct Gas {
  double rho, nu;    // density [mass/volume], kinematic viscosity [length^2/time]
};

// the gas that a cluster sees where it is
struct LocalGas {
  Vec3 u;    // velocity
  Gas gas;
};

inline double reynolds(double speed, double d, const Gas &gas)
{
  return speed * d / gas.nu;
}

// Coefficient b of F_D = b (u_g - V) on one sphere of diameter d at the given slip speed:
// F_D = C_D pi/8 rho_g d^2 |u_g - V| (u_g - V) = pi/8 rho_g nu_g d (C_D Re) (u_g - V)
inline double drag_coefficient(const DragLaw &law, const Gas &gas, double d, double slip_speed)
{
  return PI / 8.0 * gas.rho * gas.nu * d * law.cd_re(reynolds(slip_speed, d, gas));
}
// at a voidage of the place, for laws that have one
inline double drag_coefficient(const DragLaw &law, const Gas &gas, double d, double slip_speed, double voidage)
{
  return PI / 8.0 * gas.rho * gas.nu * d * law.cd_re(reynolds(slip_speed, d, gas), voidage);
}

// Voidage of a cell that holds this volume of spheres. Spheres that stand for clusters may fill a cell beyond what equal
// ones can, pi/sqrt(18) of it (Kepler): that is where the laws are cut off.
inline double voidage_of(double volume_of_spheres, double cell_volume)
{
  return 1.0 - std::min(volume_of_spheres / cell_volume, PI / std::sqrt(18.0));
}

// Where the gas carries the suspension, its pressure falls by the weight of the particles, and that acts on each of them
// besides drag: by 1/eps in all, "model B" of Gidaspow (1994); without it, "model A".
inline double with_pressure_gradient(double voidage)
{
  return 1.0 / voidage;
}

// The share F of particles that feel the gas unshielded carries the drag of single particles:
// b = (1 - F) b_cluster + F n b_particle, 0 <= F <= 1
inline double cluster_drag_coefficient(const DragLaw &law, const Gas &gas, double d, double d_p, double n,
                                       double unshielded, double slip_speed, double voidage = 1.0)
{
  double b = 0.0;
  if (unshielded < 1.0) b += (1.0 - unshielded) * drag_coefficient(law, gas, d, slip_speed, voidage);
  if (unshielded > 0.0) b += unshielded * n * drag_coefficient(law, gas, d_p, slip_speed, voidage);
  return b;
}

// One component of the drag at a coefficient b that is held for some steps; `along` is 1 where drag acts, else 0.
// For numbers and for packs of them.
template <typename Number>
inline Number held_drag(const Number &along, const Number &b, const Number &u_g, const Number &v)
{
  return along * b * (u_g - v);
}

// Factor that turns an explicit drag force into the one whose impulse over a step dt equals the
// exponential relaxation to the gas velocity at constant b: (1 - exp(-dt/tau)) / (dt/tau),
// tau = m/b. The velocity never passes the gas velocity, whatever dt/tau.
inline double exponential_factor(double dt_over_tau)
{
  if (!(dt_over_tau > 0.0)) return 1.0;
  return -std::expm1(-dt_over_tau) / dt_over_tau;
}

}    // namespace ClusterDEM
#endif
