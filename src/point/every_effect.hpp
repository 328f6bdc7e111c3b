#pragma once

#include "scene/effects.hpp"

namespace clatter::point {

/// Calls `function.operator()<set>()` for a set that contains every effect of a scene: one of two. A run in 50 digits
/// wins nothing worth having by leaving effects out, and every further set would take seconds to compile.
template <class Function>
decltype(auto) with_every_effect(const Scene& scene, Function&& function) {
  if (rotates(scene.oscillator))
    return function.template operator()<effect_sets::with_friction(Damping::light, Forcing::secular)>();
  return function.template operator()<effect_sets::with_friction(Damping::heavy, Forcing::regular)>();
}

}  // namespace clatter::point
