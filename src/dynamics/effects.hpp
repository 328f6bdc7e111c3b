#pragma once

#include <cmath>

#include "dynamics/oscillator.hpp"

namespace clatter {

enum class Damping {
  none,
  light,
  heavy
};  ///< h = 0, 0 < h < 1, h >= 1: no decay, decaying rotation, two decaying exponentials
enum class Forcing {
  none,
  regular,
  secular
};  ///< f = 0, away from resonance, at it or so near that the response is nearly secular

/// What the motion of an arc is made of; a template argument, so that what is absent costs nothing.
struct Effects {
  Damping damping = Damping::none;
  Forcing forcing = Forcing::none;

  friend constexpr bool operator==(Effects, Effects) = default;
};

/// Distance of i nu from the oscillator's roots below which forced response and transient are formed together. There
/// each of the two is up to 1/(2 * distance) times larger than the force, and so is the rounding error of their sum
/// when it is formed from both.
inline constexpr double secular_distance = 1.0 / 16.0;

/// The smallest set of effects that reproduces the oscillator exactly.
[[nodiscard]] inline Effects required_effects(const Oscillator& oscillator) {
  const double h = oscillator.damping;
  const Damping damping = h == 0.0 ? Damping::none : h < 1.0 ? Damping::light : Damping::heavy;
  if (oscillator.forcing == 0.0) return {damping, Forcing::none};
  const bool secular = std::hypot(h, oscillator.frequency - 1.0) < secular_distance;
  return {damping, secular ? Forcing::secular : Forcing::regular};
}

/// Calls `function.operator()<effects>()` for the compiled set of effects: eight of them, since heavy damping has no
/// resonance.
template <class Function>
decltype(auto) with_effects(Effects effects, Function&& function) {
  const auto with_damping = [&]<Damping damping>() -> decltype(auto) {
    if (effects.forcing == Forcing::none) return function.template operator()<Effects{damping, Forcing::none}>();
    if constexpr (damping != Damping::heavy)
      if (effects.forcing == Forcing::secular)
        return function.template operator()<Effects{damping, Forcing::secular}>();
    return function.template operator()<Effects{damping, Forcing::regular}>();
  };
  switch (effects.damping) {
    case Damping::none:
      return with_damping.template operator()<Damping::none>();
    case Damping::light:
      return with_damping.template operator()<Damping::light>();
    default:
      return with_damping.template operator()<Damping::heavy>();
  }
}

}  // namespace clatter
