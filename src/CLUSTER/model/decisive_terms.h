// What each term of E_in* = N_st + N_cc - N_smf decides: the same verdict, reached without it.

#ifndef CLUSTERDEM_DECISIVE_TERMS_H
#define CLUSTERDEM_DECISIVE_TERMS_H

#include "breakup.h"
#include "size_law.h"

namespace ClusterDEM {

// E_in* as a sum of signed parts. A positive part drives breakup; a negative one keeps clusters whole and lets them merge.
struct PowerParts {
  enum Term { ST, CC, MF, NTERMS };
  double part[NTERMS];

  PowerParts(double n_st, double n_cc, double n_smf) : part{n_st, n_cc, -n_smf} {}

  // E_in* of Eq. (2)
  double e_in() const { return part[ST] + part[CC] + part[MF]; }

  double e_in_without(Term left_out) const
  {
    double sum = 0.0;
    for (int term = 0; term < NTERMS; term++)
      if (term != left_out) sum += part[term];
    return sum;
  }

  // |part| over the sum of all |parts|; 0 where all are 0
  double share(Term term) const
  {
    const double all = std::fabs(part[ST]) + std::fabs(part[CC]) + std::fabs(part[MF]);
    return all > 0.0 ? std::fabs(part[term]) / all : 0.0;
  }
};

struct SizeRule {
  double k;             // K of Eq. (1)
  double hysteresis;    // h
  ClusterGeometry geometry;
  SizeLimits limits;

  StableSize stable(double e_in) const { return stable_size(k, e_in, geometry, limits); }

  // into what n particles of diameter d break at this stable size; a plan of no pieces if they do not
  BreakPlan breakup(int n, double d, const StableSize &size) const
  {
    if (n <= size.n || !ClusterDEM::breaks(d, size.l, hysteresis)) return {};
    const BreakPlan plan = plan_breakup(n, size.n, limits.lo);
    return plan.is_event() ? plan : BreakPlan{};
  }

  // would they break at this power? n must be within the limits
  bool breaks(int n, double d, double e_in) const
  {
    if (d * e_in < 0.999 * (1.0 + hysteresis) * k) return false;    // clearly not: l needs no cube root
    return breakup(n, d, stable(e_in)).is_event();
  }

  // Was this term decisive for the breakup of a cluster that breaks? Only what drives can be.
  bool breaks_only_by(PowerParts::Term term, const PowerParts &power, int n, double d) const
  {
    return power.part[term] > 0.0 && !breaks(n, d, power.e_in_without(term));
  }

  // Is a cluster that does not break kept whole by this term? Only what holds can do so.
  bool whole_only_by(PowerParts::Term term, const PowerParts &power, int n, double d) const
  {
    return power.part[term] < 0.0 && breaks(n, d, power.e_in_without(term));
  }

  // Would the stable size of one of two clusters that merge to n particles be too small without this term?
  bool merges_only_by(PowerParts::Term term, const PowerParts &power, int n) const
  {
    return power.part[term] < 0.0 && n > stable(power.e_in_without(term)).n;
  }
};

}    // namespace ClusterDEM
#endif
