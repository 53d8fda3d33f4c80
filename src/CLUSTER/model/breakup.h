// Breakup: into how many pieces of how many particles (paper section 2, in whole particles).

#ifndef CLUSTERDEM_BREAKUP_H
#define CLUSTERDEM_BREAKUP_H

namespace ClusterDEM {

inline bool breaks(double d, double l, double hysteresis)
{
  return d > (1.0 + hysteresis) * l;
}

// `whole` pieces of `n` particles, then, unless 0, one last piece of `last` particles
struct BreakPlan {
  int whole = 0;
  int n = 0;
  int last = 0;

  int pieces() const { return whole + (last > 0 ? 1 : 0); }
  int particles(int piece) const { return piece < whole ? n : last; }
  int largest() const { return last > n ? last : n; }
  bool is_event() const { return pieces() > 1; }
};

// n div n_l pieces of n_l particles and one of n mod n_l; a remainder below the lower limit is
// folded into a sibling. A plan of one piece is no event.
inline BreakPlan plan_breakup(int n, int n_l, int lower_limit)
{
  if (n_l <= 0 || n <= n_l) return {1, n, 0};
  BreakPlan plan{n / n_l, n_l, n % n_l};
  if (plan.last > 0 && plan.last < lower_limit) {
    plan.whole--;
    plan.last += n_l;
  }
  return plan;
}

}    // namespace ClusterDEM
#endif
