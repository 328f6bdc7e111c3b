#pragma once

#include <limits>

#include "scene/stops.hpp"

namespace clatter {
inline namespace scene {

/// A mass that lies loose in a housing which the main mass carries: it moves freely between two walls, rigid or soft,
/// and the main mass feels their forces. Its place in the housing is z = y - x, with y its displacement and x that of
/// the main mass.
template <class Number>
struct BasicLooseMass {
  Number ratio{0.0};                                       ///< eps, its mass over the main mass, >= 0; 0: there is none
  Number lower{-std::numeric_limits<double>::infinity()};  ///< z at the lower wall; -inf: none
  Number upper{std::numeric_limits<double>::infinity()};   ///< z at the upper wall; +inf: none
  Restitution<Number> restitution_lower{};                 ///< of the lower wall
  Restitution<Number> restitution_upper{};                 ///< of the upper wall
  Number stiffness_lower{std::numeric_limits<double>::infinity()};  ///< kappa of the lower wall, > 0; inf: rigid
  Number stiffness_upper{std::numeric_limits<double>::infinity()};  ///< kappa of the upper wall, > 0; inf: rigid
  Number damping_lower{0.0};    ///< zeta of the lower wall, by the reduced mass eps/(1 + eps), >= 0; only of a soft one
  Number damping_upper{0.0};    ///< zeta of the upper wall, by the reduced mass eps/(1 + eps), >= 0; only of a soft one
  Number load{0.0};             ///< constant acceleration y'' between impacts, any finite
  Number place{0.0};            ///< z at tau = 0, between the walls
  Number velocity{0.0};         ///< z' at tau = 0
  Number friction{0.0};         ///< of the housing, over the main mass, >= 0: against z' on both masses
  Number friction_static{0.0};  ///< at z' = 0; no less than `friction` in a computed scene

  friend bool operator==(const BasicLooseMass&, const BasicLooseMass&) = default;
};
using LooseMass = BasicLooseMass<double>;

template <class Number = double>
[[nodiscard]] constexpr bool has_loose_mass(const BasicLooseMass<Number>& loose) {
  return loose.ratio != 0;  // NaN keeps it
}

/// The walls as stops of the loose mass.
[[nodiscard]] inline Stops walls_of(const LooseMass& loose) {
  return {.lower = loose.lower,
          .upper = loose.upper,
          .restitution_lower = loose.restitution_lower,
          .restitution_upper = loose.restitution_upper,
          .stiffness_lower = loose.stiffness_lower,
          .stiffness_upper = loose.stiffness_upper,
          .damping_lower = loose.damping_lower,
          .damping_upper = loose.damping_upper};
}

/// The mass of both that a force between them moves, over the main mass.
template <class Number>
[[nodiscard]] constexpr Number reduced_mass(const BasicLooseMass<Number>& loose) {
  return loose.ratio / (1 + loose.ratio);
}

/// Whether it rubs on its housing.
template <class Number = double>
[[nodiscard]] constexpr bool has_loose_friction(const BasicLooseMass<Number>& loose) {
  return has_loose_mass(loose) && (loose.friction != 0 || loose.friction_static != 0);  // NaN keeps it
}

/// Whether there is a soft wall on a side.
template <class Number>
[[nodiscard]] bool is_soft(const BasicLooseMass<Number>& loose, Side wall) {
  if (wall == Side::lower) return is_finite(loose.lower) && is_finite(loose.stiffness_lower);
  return wall == Side::upper && is_finite(loose.upper) && is_finite(loose.stiffness_upper);
}
template <class Number = double>
[[nodiscard]] bool has_soft_wall(const BasicLooseMass<Number>& loose) {
  return has_loose_mass(loose) && (is_soft(loose, Side::lower) || is_soft(loose, Side::upper));
}

}  // namespace scene
}  // namespace clatter
