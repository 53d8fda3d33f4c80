// Integral of a force law over the overlap, from where the contact begins.

#ifndef CLUSTERDEM_QUADRATURE_H
#define CLUSTERDEM_QUADRATURE_H

#include <array>

namespace ClusterDEM {

// Integral of f from `begin` to `end` by Gauss and Legendre's rule of 16 points in u = sqrt((x - begin)/(end - begin)).
// Contact laws go with half powers of the distance from where they begin: in u they are polynomials, and the rule is
// exact (to rounding) for powers up to x^15, half powers included; that is the linear, Hertz's and DMT's law. For JKR's,
// which is smooth, the tests find 1e-9 of the energy. Source of the points: Abramowitz & Stegun, table 25.4.
template <class Function> double integral_from_edge(Function f, double begin, double end)
{
  constexpr std::array<double, 8> half = {0.0950125098376374402, 0.281603550779258913, 0.458016777657227386,
                                          0.617876244402643748,  0.755404408355003034, 0.865631202387831744,
                                          0.944575023073232576,  0.989400934991649933};
  constexpr std::array<double, 8> weight = {0.189450610455068496,  0.182603415044923589, 0.169156519395002538,
                                            0.149595988816576732,  0.124628971255533872, 0.0951585116824927848,
                                            0.0622535239386478929, 0.0271524594117540949};
  double sum = 0.0;
  for (std::size_t k = 0; k < half.size(); k++)
    for (const double x : {-half[k], half[k]}) {
      const double u = 0.5 * (1.0 + x);
      sum += weight[k] * u * f(begin + u * u * (end - begin));
    }
  return sum * (end - begin);    // dx = 2 u du, and half of the interval from -1 to 1
}

}    // namespace ClusterDEM
#endif
