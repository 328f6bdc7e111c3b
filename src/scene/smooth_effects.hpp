#pragma once

#include <utility>

#include "scene/effects.hpp"

namespace clatter {
inline namespace scene {

/// Calls `function.operator()<E>()` with the effects of an oscillator's arcs under a force, so that they have
/// derivatives by its numbers: h = 0 counts as light damping, whose formulas hold there, too. `any_stiffness`: by k.
template <bool any_stiffness, class Function>
decltype(auto) with_smooth_effects(const Oscillator& oscillator, Function&& function) {
  constexpr Effects light{.damping = Damping::light, .forcing = Forcing::regular, .stiffness = any_stiffness};
  constexpr Effects resonant{.damping = Damping::light, .forcing = Forcing::secular, .stiffness = any_stiffness};
  constexpr Effects heavy{.damping = Damping::heavy, .forcing = Forcing::regular, .stiffness = any_stiffness};
  const bool is_heavy = any_stiffness ? !rotates(oscillator) : oscillator.damping >= 1;
  if (is_heavy) return function.template operator()<heavy>();
  return forcing_of(oscillator) == Forcing::secular ? function.template operator()<resonant>()
                                                    : function.template operator()<light>();
}

}  // namespace scene
}  // namespace clatter
