#pragma once

#include <cmath>
#include <initializer_list>

#include "scene/stops.hpp"

namespace clatter::motion {

/// A soft stop: a spring and a damper without mass, which push the mass back while their force is positive (eq. 50).
template <class Number>
struct SoftStop {
  Side side = Side::none;
  Number position{};   ///< at which it is touched
  Number stiffness{};  ///< kappa
  Number damping{};    ///< h_s = zeta kappa^(1/2): 2 h_s is the factor of x'

  [[nodiscard]] Number into(const Number& y) const { return side == Side::upper ? y : Number(-y); }
  /// The force over kappa is depth + relaxation() * rate of the depth.
  [[nodiscard]] Number relaxation() const { return 2 * damping / stiffness; }
  /// The force that it pushes with, per unit mass; negative: it would have to pull, so there is no contact.
  [[nodiscard]] Number force(const Number& depth, const Number& rate) const {
    return stiffness * depth + 2 * damping * rate;
  }
};

template <class Number, class Given>
[[nodiscard]] SoftStop<Number> soft_stop_at(const BasicStops<Given>& stops, Side side) {
  using std::sqrt;
  const bool upper = side == Side::upper;
  const Number stiffness(upper ? stops.stiffness_upper : stops.stiffness_lower);
  return {side, Number(upper ? stops.upper : stops.lower), stiffness,
          Number(upper ? stops.damping_upper : stops.damping_lower) * sqrt(stiffness)};
}

/// The soft stop beyond whose position a mass is; side none: it is between the stops.
template <class Number>
struct Within {
  Side side = Side::none;
  Number offset{};       ///< of the mass from the stop's position
  bool pressed = false;  ///< the stop pushes
};

/// Displacement and velocity decide whether the stop pushes: all that is known of a state that comes from elsewhere.
template <class Number, class Given = double>
[[nodiscard]] Within<Number> soft_stop_around(const BasicStops<Given>& stops, const Number& x, const Number& v) {
  for (const Side side : {Side::lower, Side::upper}) {
    if (!is_soft(stops, side)) continue;
    const SoftStop<Number> stop = soft_stop_at<Number>(stops, side);
    const Number offset = x - stop.position, depth = stop.into(offset);
    if (depth > 0) return {side, offset, stop.force(depth, stop.into(v)) > 0};
  }
  return {};
}

}  // namespace clatter::motion
