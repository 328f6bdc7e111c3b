#pragma once

#include <cmath>

#include "model/stops.hpp"

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

template <class Number>
[[nodiscard]] SoftStop<Number> soft_stop_at(const Stops& stops, Side side) {
  using std::sqrt;
  const bool upper = side == Side::upper;
  const Number stiffness(upper ? stops.stiffness_upper : stops.stiffness_lower);
  return {side, Number(upper ? stops.upper : stops.lower), stiffness,
          Number(upper ? stops.damping_upper : stops.damping_lower) * sqrt(stiffness)};
}

}  // namespace clatter::motion
