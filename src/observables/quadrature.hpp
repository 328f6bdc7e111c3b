#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cstddef>

namespace clatter::observables {

/// Gauss-Legendre quadrature over 0 ... length, divided into equal panels: calls `add(s, weight)` at each point. The
/// number of points of a panel is even.
template <unsigned points, class Add>
void over_panels(double length, std::size_t panels, Add&& add) {
  static_assert(points % 2 == 0);
  using Rule = boost::math::quadrature::gauss<double, points>;
  const double half = length / static_cast<double>(panels) / 2;
  for (std::size_t panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double middle = static_cast<double>(2 * panel + 1) * half, offset = half * Rule::abscissa()[i],
                   weight = half * Rule::weights()[i];
      add(middle - offset, weight);
      add(middle + offset, weight);
    }
}

}  // namespace clatter::observables
