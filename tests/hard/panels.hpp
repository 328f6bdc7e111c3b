#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace clatter::hard {

/// Integral of y(motion, time) over an arc by Gauss-Legendre panels, for y that oscillates by up to `rate` radians in a
/// unit of time; `size` receives the integral of |y|. Twenty nodes for four radians and seven for half a radian err far
/// below rounding.
template <class A, class Integrand>
[[nodiscard]] auto integral(const A& arc, double length, double rate, const Integrand& y, double& size) {
  const auto at = [&](double s) { return y(arc.at(s), s); };
  if (length * rate < 0.5) return boost::math::quadrature::gauss<double, 7>::integrate(at, 0.0, length, &size);
  const double panels = std::ceil(length * rate / 4);
  decltype(at(0.0)) sum = 0;
  size = 0;
  for (double i = 0; i < panels; i += 1) {
    double part = 0;
    sum += boost::math::quadrature::gauss<double, 20>::integrate(at, length * i / panels, length * (i + 1) / panels,
                                                                 &part);
    size += part;
  }
  return sum;
}

}  // namespace clatter::hard
