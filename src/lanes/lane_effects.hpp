#pragma once

#include "model/effects.hpp"

namespace clatter::lanes {

/// The two sets of effects that lanes are compiled for, each with step functions of its own: a spring with k = 1, and
/// none or an unstable one (k = 0 or -1). The first costs nothing for the second.
inline constexpr Effects sprung = effect_sets::complete(Damping::light, Forcing::regular);
inline constexpr Effects unsprung = effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular);

}  // namespace clatter::lanes
