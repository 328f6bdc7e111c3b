#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/effects.hpp"

namespace clatter::observables {

/// A pair of points of Gauss-Legendre quadrature over -1 ... 1, at -abscissa and +abscissa, and the weight of each.
struct GaussPair {
  double abscissa, weight;
};

/// The pairs of the rules with 10 and 20 points, from the middle outward.
extern const std::array<GaussPair, 5> gauss_of_ten;
extern const std::array<GaussPair, 10> gauss_of_twenty;

/// Gauss-Legendre quadrature over a panel of time: calls `add(s, weight)` at each of its 10 or 20 points.
template <unsigned points, class Add>
void over_panel(double middle, double half, Add&& add) {
  static_assert(points == 10 || points == 20);
  const auto over = [&](const auto& pairs) {
    for (const GaussPair& pair : pairs) {
      const double offset = half * pair.abscissa, weight = half * pair.weight;
      add(middle - offset, weight);
      add(middle + offset, weight);
    }
  };
  if constexpr (points == 10) return over(gauss_of_ten);
  if constexpr (points == 20) return over(gauss_of_twenty);
}

/// How fast an arc changes, as frequencies and decay rates: by all of it, and by what is left of it once the fast mode
/// of heavy damping, which decays from the beginning of the arc on, is gone.
struct Pace {
  double fastest, lasting;

  /// With a wave of a frequency.
  [[nodiscard]] Pace with(double frequency) const { return {fastest + frequency, lasting + frequency}; }
};
template <class Constants>
[[nodiscard]] Pace pace_of(const Constants& constants) {
  const auto fastest = static_cast<double>(constants.rate);
  if constexpr (Constants::effects.damping != Damping::heavy) return {fastest, fastest};
  const double force = static_cast<double>(constants.nu) *
                       (constants.has_orders() ? static_cast<double>(constants.shape.orders.highest()) : 1.0);
  const auto lasting = std::max(force, std::abs(static_cast<double>(constants.slow)));
  return {fastest, std::min(lasting, fastest)};
}

/// Calls `panel(middle, half)` with panels of time 0 ... length in which an arc turns by no more than `most` radians;
/// returns how many there are. What decays is integrated by the rule as long as it does so over no more time than has
/// passed since its beginning: of e^{-t}, 4 <= t <= 8, 20 points err by less than 1e-20. So panels grow up to those of
/// what lasts, and the decay rate costs its logarithm.
template <class Of>
double for_each_panel(double length, const Pace& pace, double most, Of&& panel) {
  double begin = 0.0, rate = pace.fastest, count = 0.0;
  if (pace.fastest > 4 * pace.lasting) {
    rate = pace.lasting;
    for (double end = most / pace.fastest; begin < length && (end - begin) * rate < most; end *= 2, ++count) {
      const double until = std::min(end, length);
      panel((begin + until) / 2, (until - begin) / 2);
      begin = until;
    }
    if (!(begin < length)) return count;
  }
  const double panels = std::max(1.0, std::ceil((length - begin) * rate / most)), half = (length - begin) / panels / 2;
  for (double i = 0; i < panels; ++i) panel(begin + (2 * i + 1) * half, half);
  return count + panels;
}
/// Gauss-Legendre quadrature over them; returns the number of points.
template <unsigned points, class Add>
double over_panels(double length, const Pace& pace, double most, Add&& add) {
  return points *
         for_each_panel(length, pace, most, [&](double middle, double half) { over_panel<points>(middle, half, add); });
}

}  // namespace clatter::observables
