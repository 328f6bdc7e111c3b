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

  friend bool operator==(const BasicStops&, const BasicStops&) = default;
};
using Stops = BasicStops<double>;

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
