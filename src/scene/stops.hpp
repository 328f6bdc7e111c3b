#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "math/number.hpp"
#include "scene/restitution.hpp"

namespace clatter {
inline namespace scene {

enum class Side : std::int8_t { lower = -1, none = 0, upper = 1 };

/// Index of a stop in results: 0 the lower, 1 the upper one.
[[nodiscard]] constexpr std::size_t index_of(Side side) { return side == Side::upper ? 1 : 0; }

/// +1 at the upper stop, -1 at the lower one.
[[nodiscard]] constexpr int sign_of(Side side) { return static_cast<int>(side); }

[[nodiscard]] constexpr Side opposite(Side side) { return static_cast<Side>(-sign_of(side)); }

/// The motion of a stop by itself, in the frame of the base that carries it: amplitude * sin(theta + phase), theta
/// being the phase of the force.
template <class Number>
struct BasicStopMotion {
  Number amplitude{0.0};  ///< any finite
  Number phase{0.0};      ///< by which the stop leads the force, rad

  friend bool operator==(const BasicStopMotion&, const BasicStopMotion&) = default;
};
using StopMotion = BasicStopMotion<double>;

/// The two stops. At a rigid one the mass keeps a share of its speed (eq. 4): x'+ = -R x'-. A soft one is a spring and
/// a damper that push the mass back while it is beyond the stop's position (eq. 50), and never pull.
template <class Number>
struct BasicStops {
  Number lower{-std::numeric_limits<double>::infinity()};           ///< position of the lower stop; -inf: none
  Number upper{std::numeric_limits<double>::infinity()};            ///< position of the upper stop; +inf: none
  Restitution<Number> restitution_lower{};                          ///< of the lower stop
  Restitution<Number> restitution_upper{};                          ///< of the upper stop
  Number stiffness_lower{std::numeric_limits<double>::infinity()};  ///< kappa of the lower stop, > 0; inf: rigid
  Number stiffness_upper{std::numeric_limits<double>::infinity()};  ///< kappa of the upper stop, > 0; inf: rigid
  Number damping_lower{0.0};  ///< zeta, damping ratio of the lower stop, >= 0; only of a soft one
  Number damping_upper{0.0};  ///< zeta, damping ratio of the upper stop, >= 0; only of a soft one
  BasicStopMotion<Number> motion_lower{}, motion_upper{};  ///< of each by itself; 0: it stands in the frame of the base

  friend bool operator==(const BasicStops&, const BasicStops&) = default;
};
using Stops = BasicStops<double>;

/// The motion of the stop on a side by itself.
template <class Number>
[[nodiscard]] const BasicStopMotion<Number>& motion_of(const BasicStops<Number>& stops, Side side) {
  return side == Side::upper ? stops.motion_upper : stops.motion_lower;
}
/// Whether there is a stop that moves by itself.
template <class Number>
[[nodiscard]] bool move_by_themselves(const BasicStops<Number>& stops) {
  return (is_finite(stops.lower) && stops.motion_lower.amplitude != 0) ||
         (is_finite(stops.upper) && stops.motion_upper.amplitude != 0);
}

/// The stops where their motion brings them: as far out, or as far in, as it ever does.
[[nodiscard]] inline Stops outermost(Stops stops) {
  stops.lower -= std::abs(stops.motion_lower.amplitude), stops.upper += std::abs(stops.motion_upper.amplitude);
  return stops;
}
[[nodiscard]] inline Stops innermost(Stops stops) {
  stops.lower += std::abs(stops.motion_lower.amplitude), stops.upper -= std::abs(stops.motion_upper.amplitude);
  return stops;
}

/// Stops at one phase of their motion by themselves, with their velocities.
struct StopsNow : Stops {
  double velocity_lower = 0.0, velocity_upper = 0.0;

  /// At the phase theta of the force, rad, of frequency nu.
  StopsNow(const Stops& stops, double nu, double theta) : Stops(stops) {
    const auto move = [&](const StopMotion& motion, double& place, double& velocity) {
      if (motion.amplitude == 0) return;
      place += motion.amplitude * std::sin(theta + motion.phase);
      velocity = motion.amplitude * nu * std::cos(theta + motion.phase);
    };
    move(motion_lower, lower, velocity_lower), move(motion_upper, upper, velocity_upper);
  }
};

/// Whether there is a soft stop on a side.
template <class Number>
[[nodiscard]] bool is_soft(const BasicStops<Number>& stops, Side side) {
  if (side == Side::lower) return is_finite(stops.lower) && is_finite(stops.stiffness_lower);
  return side == Side::upper && is_finite(stops.upper) && is_finite(stops.stiffness_upper);
}
template <class Number = double>
[[nodiscard]] bool has_soft_stop(const BasicStops<Number>& stops) {
  return is_soft(stops, Side::lower) || is_soft(stops, Side::upper);
}

/// The soft stop beyond whose position a displacement lies; none if there is none.
[[nodiscard]] inline Side soft_stop_beyond(const Stops& stops, double x) {
  if (x < stops.lower && is_soft(stops, Side::lower)) return Side::lower;
  return x > stops.upper && is_soft(stops, Side::upper) ? Side::upper : Side::none;
}

/// The stops that the mass can't pass: soft ones count as none.
[[nodiscard]] inline Stops rigid_ones(Stops stops) {
  if (is_soft(stops, Side::lower)) stops.lower = -std::numeric_limits<double>::infinity();
  if (is_soft(stops, Side::upper)) stops.upper = std::numeric_limits<double>::infinity();
  return stops;
}

/// The law of the stop on a side.
template <class Number>
[[nodiscard]] const Restitution<Number>& law_of(const BasicStops<Number>& stops, Side side) {
  return side == Side::upper ? stops.restitution_upper : stops.restitution_lower;
}
/// The same with numbers of another type.
template <class Number, class Given = double>
[[nodiscard]] Restitution<Number> restitution_at(const BasicStops<Given>& stops, Side side) {
  return Restitution<Number>(law_of(stops, side));
}

/// Whether contacts with a stop take energy: a soft one by its damper, a rigid one by its restitution.
[[nodiscard]] inline bool takes_energy(const Stops& stops, Side side) {
  if (is_soft(stops, side)) return !((side == Side::lower ? stops.damping_lower : stops.damping_upper) <= 0);
  return law_of(stops, side).takes_energy();
}
/// Whether the slowest contacts do.
[[nodiscard]] inline bool takes_energy_at_rest(const Stops& stops, Side side) {
  return is_soft(stops, side) ? takes_energy(stops, side) : law_of(stops, side).loses();
}

}  // namespace scene
}  // namespace clatter
