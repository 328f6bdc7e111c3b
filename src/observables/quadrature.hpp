#pragma once

#include <array>
#include <cstddef>

namespace clatter::observables {

/// A pair of points of Gauss-Legendre quadrature over -1 ... 1, at -abscissa and +abscissa, and the weight of each.
struct GaussPair {
  double abscissa, weight;
};

/// The pairs of the rule with 10 or 20 points, from the middle outward.
template <unsigned points>
[[nodiscard]] const std::array<GaussPair, points / 2>& gauss_pairs();

/// Gauss-Legendre quadrature over 0 ... length, divided into equal panels: calls `add(s, weight)` at each point.
template <unsigned points, class Add>
void over_panels(double length, std::size_t panels, Add&& add) {
  const double half = length / static_cast<double>(panels) / 2;
  for (std::size_t panel = 0; panel < panels; ++panel)
    for (const GaussPair& pair : gauss_pairs<points>()) {
      const double middle = static_cast<double>(2 * panel + 1) * half, offset = half * pair.abscissa,
                   weight = half * pair.weight;
      add(middle - offset, weight);
      add(middle + offset, weight);
    }
}

template <>
[[nodiscard]] const std::array<GaussPair, 5>& gauss_pairs<10>();
template <>
[[nodiscard]] const std::array<GaussPair, 10>& gauss_pairs<20>();

}  // namespace clatter::observables
