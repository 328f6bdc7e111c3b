#pragma once

#include <array>
#include <optional>

#include "ball.hpp"

namespace verify {

enum class Side { lower, upper };

[[nodiscard]] inline std::size_t index_of(Side side) { return side == Side::upper ? 1 : 0; }
/// The direction from between the stops into one of them.
[[nodiscard]] inline int sign_of(Side side) { return side == Side::upper ? 1 : -1; }
[[nodiscard]] inline Side opposite(Side side) { return side == Side::upper ? Side::lower : Side::upper; }
[[nodiscard]] inline const char* name_of(Side side) { return side == Side::upper ? "upper" : "lower"; }

/// A stop: rigid (eq. 4), or a spring and a damper without mass (eq. 50).
struct Stop {
  Ball position;
  bool soft = false;
  Ball R;      ///< restitution of a rigid stop
  Ball kappa;  ///< stiffness of a soft stop
  Ball zeta;   ///< its damping ratio
  Ball h_s;    ///< its damping, zeta kappa^(1/2)

  /// Its force falls to 0 if x + q v is the position.
  [[nodiscard]] Ball q() const { return soft ? Ball(2) * h_s / kappa : Ball(0); }
};

/// x'' + 2h x' + k x = f sin(nu tau + phase) + load between two stops.
struct Scene {
  Ball h, k, f, nu, load, phase;
  std::array<std::optional<Stop>, 2> stops;  ///< [side]

  [[nodiscard]] const Stop& stop(Side side) const { return *stops[index_of(side)]; }
  [[nodiscard]] Ball period() const { return Ball(2) * Ball::pi() / nu; }
  /// The force that presses a mass at rest into a stop (eq. 22), at a phase whose sine is given.
  [[nodiscard]] Ball pressing(Side side, const Ball& sine) const {
    return Ball(sign_of(side)) * (f * sine + load - k * stop(side).position);
  }
};

}  // namespace verify
