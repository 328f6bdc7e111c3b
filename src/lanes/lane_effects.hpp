#pragma once

#include <cstddef>

#include "scene/effects.hpp"

namespace clatter::lanes {

/// The sets of effects that lanes are compiled for, each with step functions of its own: a spring with k = 1; none or
/// an unstable one (k = 0 or -1); a spring with k = 1 and a soft stop. None costs anything for the others.
inline constexpr Effects sprung = effect_sets::complete(Damping::light, Forcing::regular);
inline constexpr Effects unsprung = effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular);
inline constexpr Effects cushioned = effect_sets::with_soft_stops(Damping::light, Forcing::regular);

inline constexpr std::size_t kinds = 3;  ///< of lanes

/// The number of the kind of lanes that a point with these effects needs.
[[nodiscard]] constexpr std::size_t kind_of(const Effects& effects) {
  return effects.soft ? 2 : effects.stiffness ? 1 : 0;
}

/// The effects that step functions depend on.
[[nodiscard]] constexpr Effects step_effects(const Effects& effects) {
  Effects of_step = effects.arc();
  of_step.soft = effects.soft;
  return of_step;
}

}  // namespace clatter::lanes
