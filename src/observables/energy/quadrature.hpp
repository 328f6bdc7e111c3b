#pragma once

#include <array>
#include <cstddef>

namespace clatter::observables {

/// A pair of points of Gauss-Legendre quadrature over -1 ... 1, at -abscissa and +abscissa, and the weight of each.
struct GaussPair {
  double abscissa, weight;
};

/// The pairs of the rules with 10 and 20 points, from the middle outward.
extern const std::array<GaussPair, 5> gauss_of_ten;
extern const std::array<GaussPair, 10> gauss_of_twenty;

/// Gauss-Legendre quadrature over 0 ... length, divided into equal panels: calls `add(s, weight)` at each of the 10 or
/// 20 points of a panel.
template <unsigned points, class Add>
void over_panels(double length, std::size_t panels, Add&& add) {
  static_assert(points == 10 || points == 20);
  const double half = length / static_cast<double>(panels) / 2;
  const auto over = [&](const auto& pairs) {
    for (std::size_t panel = 0; panel < panels; ++panel)
      for (const GaussPair& pair : pairs) {
        const double middle = static_cast<double>(2 * panel + 1) * half, offset = half * pair.abscissa,
                     weight = half * pair.weight;
        add(middle - offset, weight);
        add(middle + offset, weight);
      }
  };
  if constexpr (points == 10) return over(gauss_of_ten);
  if constexpr (points == 20) return over(gauss_of_twenty);
}

}  // namespace clatter::observables
