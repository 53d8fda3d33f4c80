// C_D Re of any drag law, tabulated: a drag law's powers cost several times what the engine needs to
// move a cluster. Cubic polynomials, 128 to each octave of Re; relative error below 1e-10. A bin that
// a cubic cannot meet to that (a kink of the law), and Re out of range, are left to the law itself.

#ifndef CLUSTERDEM_DRAG_TABLE_H
#define CLUSTERDEM_DRAG_TABLE_H

#include "drag_law.h"

#include <cstdint>
#include <cstring>

namespace ClusterDEM {

class DragTable : public DragLaw {
 public:
  static constexpr double RELATIVE_ERROR = 1.0e-10;

  explicit DragTable(std::unique_ptr<DragLaw> exact) :
      law_(std::move(exact)), bins_(bin_of(HIGHEST) - bin_of(LOWEST))
  {
    for (std::size_t k = 0; k < bins_.size(); k++) bins_[k] = fit(start_of(k), start_of(k + 1));
  }

  double cd_re(double re, double) const override { return DragTable::cd_re(re); }
  double cd_re(double re) const override
  {
    const std::int64_t k = bin_of(re) - bin_of(LOWEST);
    if (k < 0 || k >= static_cast<std::int64_t>(bins_.size())) return law_->cd_re(re);
    const Cubic &c = bins_[k];
    const double t = re - start_of(k);
    const double y = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    return y == y ? y : law_->cd_re(re);    // NaN marks a bin that is left to the law
  }

 private:
  using Cubic = std::array<double, 4>;
  static constexpr int BITS = 45;    // of the 52 of a mantissa that lie within a bin
  static constexpr double LOWEST = 1.0 / 1024, HIGHEST = 65536.0;

  std::unique_ptr<DragLaw> law_;
  std::vector<Cubic> bins_;

  // positive doubles ascend as their bit patterns do: exponent and leading bits number the bins
  static std::int64_t bin_of(double re)
  {
    std::int64_t bits;
    std::memcpy(&bits, &re, sizeof(bits));
    return bits >> BITS;
  }
  static double start_of(std::int64_t k)
  {
    const std::int64_t bits = (bin_of(LOWEST) + k) << BITS;
    double re;
    std::memcpy(&re, &bits, sizeof(re));
    return re;
  }

  // through four points of the bin, by divided differences
  Cubic fit(double lo, double hi) const
  {
    double t[4], d[4];
    for (int i = 0; i < 4; i++) {
      t[i] = (hi - lo) * i / 3.0;
      d[i] = law_->cd_re(lo + t[i]);
    }
    for (int order = 1; order < 4; order++)
      for (int i = 3; i >= order; i--) d[i] = (d[i] - d[i - 1]) / (t[i] - t[i - order]);
    // Newton's form, expanded about t = 0
    Cubic c = {d[3], 0.0, 0.0, 0.0};
    for (int i = 2; i >= 0; i--) {
      for (int power = 3; power > 0; power--) c[power] = c[power - 1] - t[i] * c[power];
      c[0] = d[i] - t[i] * c[0];
    }
    for (int i = 0; i <= 12; i++) {
      const double s = (hi - lo) * i / 12.0, exact = law_->cd_re(lo + s);
      const double y = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
      if (!(std::fabs(y - exact) <= 0.1 * RELATIVE_ERROR * std::fabs(exact))) return {NAN, 0.0, 0.0, 0.0};
    }
    return c;
  }
};

}    // namespace ClusterDEM
#endif
