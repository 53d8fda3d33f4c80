// The size law, Eqs. (1) and (2): l = K / E_in*, E_in* = N_st + N_cc - N_smf.
// Powers are per unit mass of solids (W/kg), K in m W/kg. Where the paper can be read in several
// ways, each reading is a named option; the first of each enum is the default.

#ifndef CLUSTERDEM_SIZE_LAW_H
#define CLUSTERDEM_SIZE_LAW_H

#include "cluster.h"
#include "drag_law.h"
#include "vector3.h"

namespace ClusterDEM {

enum class NstReading { PARTICLE, CLUSTER, CELL };
enum class NsmfReading { EMMS, PAPER };
enum class UpReading { OWN, CELL, SUPERFICIAL, VECTOR };

// Wen & Yu (1966): Re_mf = sqrt(33.7^2 + 0.0408 Ar) - 33.7, Ar = g d_p^3 (rho_p - rho_g)/(rho_g nu^2)
inline double umf_wen_yu(double d_p, double rho_p, const Gas &gas, double g)
{
  const double ar = g * d_p * d_p * d_p * (rho_p - gas.rho) / (gas.rho * gas.nu * gas.nu);
  if (!(ar > 0.0)) return 0.0;
  // a^2 - b^2 = (a - b)(a + b) keeps the digits that the difference of two near numbers loses
  const double root = std::sqrt(33.7 * 33.7 + 0.0408 * ar);
  return 0.0408 * ar / (root + 33.7) * gas.nu / d_p;
}

// N_st = n_i F_D . u_g / [(1 - eps_i) rho_s]: the power of the gas on the solids, signed.
// `drag` and `mass` are of one primary particle (reading `particle`) or of the cluster (`cluster`).
inline double n_st(const Vec3 &drag, const Vec3 &gas_velocity, double mass)
{
  return dot(drag, gas_velocity) / mass;
}

// N_cc = |sum_j F_ij . dU_ij| / m_i, times the factor of the reading (1: as printed)
inline double n_cc(double power_of_contacts, double mass, double factor)
{
  return factor * std::fabs(power_of_contacts) / mass;
}

// N_smf = [U_mf + c U_p / (1 - eps_mf)] g, c = eps_mf (`emms`) or 1 (as printed: `paper`)
inline double n_smf(NsmfReading reading, double u_mf, double u_p, double eps_mf, double g)
{
  const double c = reading == NsmfReading::EMMS ? eps_mf : 1.0;
  return (u_mf + c * u_p / (1.0 - eps_mf)) * g;
}

// U_p of `own`: |V_g|; of `cell`: the mass mean of |V_g| over the clusters of the cell; of `superficial`: that times the
// solids fraction of the cell; of `vector`: |mass mean of V_g|, the speed of the particle phase of the cell
inline double mean_speed(double mass_times_speed, double mass)
{
  return mass_times_speed / mass;
}
inline double superficial_speed(double mean_speed, double mass, double rho_p, double volume)
{
  return mean_speed * (mass / (rho_p * volume));
}

// K of the EMMS literature: l = d_p at N = U_p g/(1 - eps_max), l -> inf at N = N_smf;
// K = d_p [U_p/(1 - eps_max) - (U_mf + eps_mf U_p/(1 - eps_mf))] g, U_p superficial
inline double k_emms(double d_p, double u_p, double u_mf, double eps_mf, double g, double eps_max = 0.9997)
{
  return d_p * (u_p / (1.0 - eps_max) - (u_mf + eps_mf * u_p / (1.0 - eps_mf))) * g;
}

struct StableSize {
  double l;    // diameter [length], within the limits
  int n;       // the same in whole particles, within the limits
};

// Eq. (1) within the limits. E_in* <= 0 (or not a number): nothing breaks the cluster, l is the
// upper limit.
inline StableSize stable_size(double k, double e_in, const ClusterGeometry &geometry, const SizeLimits &limits)
{
  if (!(e_in > 0.0)) return {geometry.diameter(limits.hi), limits.hi};
  const double l = k / e_in;
  // a diameter that was made from a whole n gives that n back, not n - 1
  const double particles = geometry.particles_in(l) * (1.0 + 1.0e-12);
  const int n = limits.clamp(particles);
  // cube roots only where a limit is met
  if (!(particles > limits.lo)) return {geometry.diameter(limits.lo), n};
  return {particles < limits.hi ? l : std::min(l, geometry.diameter(limits.hi)), n};
}

}    // namespace ClusterDEM
#endif
