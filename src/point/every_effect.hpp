#pragma once

#include <utility>

#include "scene/effects.hpp"

namespace clatter::point {

/// Calls `function.operator()<set>()` for a set that contains every effect of a scene without a loose mass: one of two.
/// A run in 50 digits wins nothing worth having by leaving effects out, and every further set would take seconds to
/// compile.
template <class Function>
decltype(auto) with_every_effect(const Scene& scene, Function&& function) {
  if (rotates(scene.oscillator))
    return function.template operator()<effect_sets::with_friction(Damping::light, Forcing::secular)>();
  return function.template operator()<effect_sets::with_friction(Damping::heavy, Forcing::regular)>();
}

/// The same for a scene whose stops don't move by themselves, and which may have a loose mass: one of four.
template <class Function>
decltype(auto) with_every_effect_but_own_motion(const Scene& scene, Function&& function) {
  if (has_loose_mass(scene.loose)) {
    if (rotates(scene.oscillator))
      return function.template operator()<effect_sets::with_everything(Damping::light, Forcing::secular)>();
    return function.template operator()<effect_sets::with_everything(Damping::heavy, Forcing::regular)>();
  }
  if (rotates(scene.oscillator))
    return function.template operator()<effect_sets::with_standing_stops(Damping::light, Forcing::secular)>();
  return function.template operator()<effect_sets::with_standing_stops(Damping::heavy, Forcing::regular)>();
}

}  // namespace clatter::point
