#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/number.hpp"

namespace clatter::motion {

/// Bounds of all motions near an instant of one of them, for some time before and after it.
struct LocalBounds {
  double acceleration, jerk;
  double growth;  ///< of the energy norm of their differences, backwards in time
};

/// The oscillator that motions belong to between two events: x'' + 2 h x' + k x = force.
struct Field {
  double h = 0, k = 1;
  double shake = 0;   ///< |f| nu, times the largest |ds/dtheta| of a force that is no sine
  double weight = 1;  ///< Omega: the norm of a difference is that of (Omega x, v)
  double drift = 0;   ///< bound of the rate at which the norm grows, forwards (eqs. 48, 57); backwards 2 h more

  /// The field of some arcs in the norm of (x, v), where time is counted in units of 1/`rate`.
  template <class ArcConstants>
  [[nodiscard]] static Field of(const ArcConstants& constants, double rate) {
    const double k = constants.k / (rate * rate), shake = static_cast<double>(constants.steepest()) *
                                                          std::abs(constants.f) / (rate * rate) * (constants.nu / rate);
    return {constants.h / rate, k, shake, 1, std::abs(1 - k) / 2};
  }

  /// By how much the norm of a difference grows at most in a time, forwards: by the rate, or, unless the spring pushes
  /// away, by the sizes of the propagator's entries, since a lack of energy doesn't make a motion faster (eq. 48).
  [[nodiscard]] double growth(double time) const {
    const double by_rate = drift > 0 ? std::exp(drift * time) : 1.0;
    if (!(k >= 0)) return by_rate;
    const double root = std::sqrt(k), b = weight * std::min(time, 1 / root), c = std::min(k * time, root) / weight;
    return std::min(by_rate, norm(1.0, (b - c) / 2) + (b + c) / 2);
  }

  /// By x''' = f nu cos(theta) - k x' - 2 h x''; infinite if the time is too long for that.
  [[nodiscard]] LocalBounds near(double speed, double acceleration, double time) const {
    const double size = std::abs(k), share = size * time * time + 2 * h * time;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!(share <= 0.5)) return {infinity, infinity, infinity};
    const double most = (acceleration + time * (shake + size * speed)) / (1 - share);
    return {most, shake + size * speed + most * (size * time + 2 * h), std::exp((2 * h + drift) * time)};
  }
};

}  // namespace clatter::motion
