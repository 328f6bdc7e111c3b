#include "scene/effects.hpp"

namespace clatter {
inline namespace scene {

Forcing forcing_of(const Oscillator& oscillator) {
  if (oscillator.forcing == 0.0) return Forcing::none;
  if (!oscillator.shape.is_sine())  // arcs of a piece form response and transient together
    return rotates(oscillator) ? Forcing::secular : Forcing::regular;
  if (oscillator.stiffness != 1.0)
    return rotates(oscillator) ? forcing_of(with_unit_spring(oscillator)) : Forcing::regular;
  const double h = oscillator.damping, detuning = oscillator.frequency - 1.0;
  const bool is_far = h >= secular_distance || std::abs(detuning) >= secular_distance;  // most are, without a root
  return !is_far && std::hypot(h, detuning) < secular_distance ? Forcing::secular : Forcing::regular;
}

}  // namespace scene
}  // namespace clatter
