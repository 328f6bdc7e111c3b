#pragma once

#include <array>
#include <cmath>

#include "branches/shaken_scene.hpp"
#include "motion/arc.hpp"

namespace clatter::branches {

/// The parameters of a scene, as numbers of a type that may carry derivatives by some of them.
template <class Number>
struct Parameters {
  Number h, f, nu, load, lower, upper, R_lower, R_upper, k, stop_amplitude, base_amplitude;

  /// Each of them.
  static constexpr std::array<Number Parameters::*, 11> all{&Parameters::h,
                                                            &Parameters::f,
                                                            &Parameters::nu,
                                                            &Parameters::load,
                                                            &Parameters::lower,
                                                            &Parameters::upper,
                                                            &Parameters::R_lower,
                                                            &Parameters::R_upper,
                                                            &Parameters::k,
                                                            &Parameters::stop_amplitude,
                                                            &Parameters::base_amplitude};

  Parameters() = default;
  explicit Parameters(const ShakenScene& scene)
      : h(scene.oscillator.damping),
        f(scene.oscillator.forcing),
        nu(scene.oscillator.frequency),
        load(scene.oscillator.load),
        lower(scene.stops.lower),
        upper(scene.stops.upper),
        R_lower(scene.stops.restitution_lower),
        R_upper(scene.stops.restitution_upper),
        k(scene.oscillator.stiffness),
        stop_amplitude(scene.shaking.stops),
        base_amplitude(scene.shaking.base) {}

  [[nodiscard]] const Number& position(Side stop) const { return stop == Side::upper ? upper : lower; }
  [[nodiscard]] const Number& restitution(Side stop) const { return stop == Side::upper ? R_upper : R_lower; }
  /// In the frame of what is shaken.
  [[nodiscard]] LeadingForce<Number> force() const {
    return force_in_frame(h, f, nu, k, stop_amplitude, base_amplitude);
  }
};

/// Calls `function.operator()<E>()` with the effects of a scene's arcs under a force, which have derivatives by k if it
/// varies. They don't depend on h = 0, at which the formulas of light damping hold too, so that derivatives by h exist
/// there.
template <class Function>
decltype(auto) with_arcs(const ShakenScene& scene, Function&& function, bool stiffness_varies = false) {
  const Oscillator oscillator = oscillator_in_frame(scene);
  const bool secular = forcing_of(oscillator) == Forcing::secular;
  const auto with = [&]<bool any_stiffness>(bool heavy) -> decltype(auto) {
    constexpr Effects light{.damping = Damping::light, .forcing = Forcing::regular, .stiffness = any_stiffness};
    constexpr Effects resonant{.damping = Damping::light, .forcing = Forcing::secular, .stiffness = any_stiffness};
    if (heavy)
      return function.template
      operator()<Effects{.damping = Damping::heavy, .forcing = Forcing::regular, .stiffness = any_stiffness}>();
    return secular ? function.template operator()<resonant>() : function.template operator()<light>();
  };
  if (stiffness_varies || oscillator.stiffness != 1.0) return with.template operator()<true>(!rotates(oscillator));
  return with.template operator()<false>(oscillator.damping >= 1);
}

/// A flight begins just after the impact of velocity `before` on stop `from` at phase `begin`, in rad, and is looked at
/// when the phase is `end`.
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

/// The flights at given parameters. Arcs refer to it.
template <class Number, Effects E>
class Flights {
 public:
  explicit Flights(const Parameters<Number>& parameters) : Flights(parameters, parameters.force()) {}
  Flights(const Flights&) = delete;
  Flights& operator=(const Flights&) = delete;

  [[nodiscard]] const motion::ArcConstants<Number, E>& constants() const { return constants_; }
  [[nodiscard]] const Parameters<Number>& parameters() const { return p_; }

  /// The arc that begins with a flight.
  [[nodiscard]] motion::Arc<Number, E> arc(const Flight<Number>& flight) const {
    return arc_from(p_.position(flight.from), Number(-p_.restitution(flight.from) * flight.before), flight.begin);
  }

  /// Flies through stops, if it meets any.
  [[nodiscard]] FlightEnd<Number> fly(const Flight<Number>& flight) const {
    const motion::Motion<Number> end = arc(flight).at(Number((flight.end - flight.begin) / p_.nu));
    return {flight.from == flight.to ? end.offset : Number(end.x - p_.position(flight.to)), end.v};
  }

  /// Motion without impacts: the response to the force, and its arc from phase 0 on. Phases of the response are those
  /// of the force.
  [[nodiscard]] Response<Number> response() const {
    if constexpr (E.stiffness) return response_to(Number(p_.k - p_.nu * p_.nu), p_.h, constants_.f, p_.nu);
    return steady_response(p_.h, constants_.f, p_.nu);
  }
  [[nodiscard]] motion::Arc<Number, E> response_arc() const {
    using std::cos, std::sin;
    const Response<Number> of_force = response();
    const Number sine = sin(lead_), cosine = cos(lead_);
    return arc_from(Number(constants_.equilibrium + of_force.displacement(sine, cosine)),
                    of_force.velocity(p_.nu, sine, cosine), Number(0));
  }

  /// Phase of the force less that of the shaking, rad.
  [[nodiscard]] const Number& lead() const { return lead_; }

 private:
  Flights(const Parameters<Number>& parameters, const LeadingForce<Number>& force)
      : p_(parameters),
        lead_(force.lead),
        constants_(motion::ArcConstants<Number, E>::of(p_.h, force.amplitude, p_.nu, p_.load, p_.k)) {}

  [[nodiscard]] motion::Arc<Number, E> arc_from(const Number& x, const Number& v, const Number& phase) const {
    using std::cos, std::sin;
    const Number of_force = phase + lead_, sine = sin(of_force), cosine = cos(of_force);
    return {constants_,
            {Number(0), x, v, constants_.acceleration(Number(x - constants_.equilibrium), v, sine), sine, cosine}};
  }

  Parameters<Number> p_;
  Number lead_;
  motion::ArcConstants<Number, E> constants_;
};

}  // namespace clatter::branches
