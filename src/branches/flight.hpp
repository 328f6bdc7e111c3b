#pragma once

#include <cmath>

#include "model/scene.hpp"
#include "motion/arc.hpp"

namespace clatter::branches {

/// The parameters of a scene, as numbers of a type that may carry derivatives by some of them.
template <class Number>
struct Parameters {
  Number h, f, nu, load, lower, upper, R_lower, R_upper;

  Parameters() = default;
  explicit Parameters(const Scene& scene)
      : h(scene.oscillator.damping),
        f(scene.oscillator.forcing),
        nu(scene.oscillator.frequency),
        load(scene.oscillator.load),
        lower(scene.stops.lower),
        upper(scene.stops.upper),
        R_lower(scene.stops.restitution_lower),
        R_upper(scene.stops.restitution_upper) {}

  [[nodiscard]] const Number& position(Side stop) const { return stop == Side::upper ? upper : lower; }
  [[nodiscard]] const Number& restitution(Side stop) const { return stop == Side::upper ? R_upper : R_lower; }
};

/// Calls `function.operator()<E>()` with the effects of arcs under a force. They don't depend on h = 0, at which the
/// formulas of light damping hold too, so that derivatives by h exist there.
template <class Function>
decltype(auto) with_arcs(const Oscillator& oscillator, Function&& function) {
  if (oscillator.damping >= 1)
    return function.template operator()<Effects{.damping = Damping::heavy, .forcing = Forcing::regular}>();
  if (forcing_of(oscillator) == Forcing::secular)
    return function.template operator()<Effects{.damping = Damping::light, .forcing = Forcing::secular}>();
  return function.template operator()<Effects{.damping = Damping::light, .forcing = Forcing::regular}>();
}

/// A flight begins just after the impact of velocity `before` on stop `from` at forcing phase `begin`, in rad, and is
/// looked at when the phase is `end`.
template <class Number>
struct Flight {
  Side from;
  Number begin, before;
  Side to;
  Number end;
};

/// The end of a flight, beside the stop `to`.
template <class Number>
struct FlightEnd {
  Number beyond;    ///< x less the position of the stop: 0 if the flight ends on it
  Number velocity;  ///< before the impact
};

/// The arc that begins with a flight.
template <class Number, Effects E>
[[nodiscard]] motion::Arc<Number, E> arc_of(const motion::ArcConstants<Number, E>& constants,
                                            const Parameters<Number>& p, const Flight<Number>& flight) {
  using std::cos, std::sin;
  const Number& x = p.position(flight.from);
  const Number v = -p.restitution(flight.from) * flight.before, sine = sin(flight.begin), cosine = cos(flight.begin);
  return {constants, {Number(0), x, v, constants.acceleration(Number(x - p.load), v, sine), sine, cosine}};
}

/// Flies through stops, if it meets any.
template <Effects E, class Number>
[[nodiscard]] FlightEnd<Number> fly(const Parameters<Number>& p, const Flight<Number>& flight) {
  const auto constants = motion::ArcConstants<Number, E>::of(p.h, p.f, p.nu, p.load);
  const motion::Motion<Number> end = arc_of(constants, p, flight).at(Number((flight.end - flight.begin) / p.nu));
  return {flight.from == flight.to ? end.offset : Number(end.x - p.position(flight.to)), end.v};
}

}  // namespace clatter::branches
