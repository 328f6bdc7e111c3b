#include "scene/effects.hpp"

namespace clatter {
inline namespace scene {

Forcing forcing_of(const Oscillator& oscillator) {
  if (oscillator.forcing == 0.0) return Forcing::none;
  if (oscillator.stiffness != 1.0)
    return rotates(oscillator) ? forcing_of(with_unit_spring(oscillator)) : Forcing::regular;
  const bool secular = std::hypot(oscillator.damping, oscillator.frequency - 1.0) < secular_distance;
  return secular ? Forcing::secular : Forcing::regular;
}

}  // namespace scene
}  // namespace clatter
