#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "branches/equations/followed_scene.hpp"
#include "branches/equations/orbit.hpp"
#include "branches/equations/releases.hpp"
#include "math/number.hpp"
#include "motion/arc.hpp"
#include "motion/dry_friction.hpp"
#include "motion/soft_contact.hpp"
#include "motion/walls.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::branches {

/// Calls `function.operator()<E>()` with the effects of a scene's arcs under a force, which have derivatives by k if it
/// varies.
template <class Function>
decltype(auto) with_arcs(const Scene& scene, Function&& function, bool stiffness_varies = false) {
  const Oscillator oscillator = oscillator_in_frame(scene);
  if (stiffness_varies || oscillator.stiffness != 1.0 || oscillator.shape.has_orders())
    return with_smooth_effects<true>(oscillator, std::forward<Function>(function));
  return with_smooth_effects<false>(oscillator, std::forward<Function>(function));
}

/// That of a stop, or of a wall of a loose mass.
template <class Number>
[[nodiscard]] Restitution<Number> law_at(const SceneNumbers<Number>& p, Event::Kind kind, Side side) {
  return kind == Event::Kind::strike ? motion::WallRule<Number>(p.loose).law(side) : p.law(side);
}

/// A flight begins just after an event at phase `begin`, in rad, with the coordinate and side of that as `OrbitEvent`
/// has them, and is looked at when the phase is `end`; after a stick it begins with the release.
template <class Number>
struct Flight {
  Side from;
  Number begin, coordinate;
  Side to;
  Number end;
  Event::Kind leaves = Event::Kind::impact, arrives = Event::Kind::impact;
  bool from_crest = false;    ///< after a stick whose release is at the crest of the push, just as strong as the level
  Side held_by = Side::none;  ///< the soft stop that a halt at its beginning is in

  /// The soft stop that the mass is in contact with.
  [[nodiscard]] Side pressed() const { return halts(leaves) ? held_by : presses(leaves) ? from : Side::none; }
  /// The side that the mass moves to, under dry friction.
  [[nodiscard]] Side heading() const { return OrbitEvent{.side = from, .kind = leaves}.heading(); }

  /// Whether it is a contact with a soft stop, or an interruption of one: these become infinitely short where they
  /// vanish. An interruption lies beyond the stop's position, but without a damper, on the other side of it.
  template <class AnyNumber>
  [[nodiscard]] bool may_vanish(const SceneNumbers<AnyNumber>& p) const {
    if (arrives == Event::Kind::separation) return presses(leaves);
    if (leaves != Event::Kind::separation) return false;
    return arrives == Event::Kind::renewal ||
           (arrives == Event::Kind::touch && from == to && p.soft_stop(to).damping == 0);
  }
};

/// The end of a flight, beside the stop `to`.
template <class Number>
struct FlightEnd {
  /// x less the position of the stop: 0 if the flight ends on it. At separations and renewals the force of the stop
  /// over its stiffness; that over the duration if it is zero at the beginning, too, so that a flight without duration
  /// is no solution. At a halt the velocity.
  Number beyond;
  Number coordinate;  ///< as that of the event it ends with: the velocity, or the place of a halt
};

/// The flights at given parameters. Arcs refer to it.
template <class Number, Effects E>
class Flights {
 public:
  explicit Flights(const SceneNumbers<Number>& parameters) : Flights(parameters, parameters.force()) {}
  Flights(const Flights&) = delete;
  Flights& operator=(const Flights&) = delete;

  [[nodiscard]] const motion::ArcConstants<Number, E>& constants() const { return constants_; }
  [[nodiscard]] const SceneNumbers<Number>& parameters() const { return p_; }

  /// Calls `function(arc)` with the arc that begins with a flight.
  template <class Function>
  decltype(auto) with_arc(const Flight<Number>& flight, Function&& function) const {
    if (flight.leaves == Event::Kind::impact)
      return function(arc_from(towards(opposite(flight.from)), p_.position(flight.from),
                               p_.law(flight.from).after(flight.coordinate), flight.begin));
    if (halts(flight.leaves))
      return with_constants(flight, [&](const auto& constants) { return function(arc_from_halt(constants, flight)); });
    const motion::SoftStop<Number> stop = p_.soft_stop(flight.from);
    const Number offset =
        flight.leaves == Event::Kind::touch ? Number(0) : Number(-stop.relaxation() * flight.coordinate);
    return with_constants(flight, [&](const auto& constants) {
      return function(arc_beside(constants, stop.position, offset, flight.coordinate, flight.begin));
    });
  }
  /// Calls `function(constants)` with those of the motion on a flight.
  template <class Function>
  decltype(auto) with_constants(const Flight<Number>& flight, Function&& function) const {
    if (!slips_) return with_constants(flight.pressed(), function);
    if (flight.pressed() == Side::none) return function(slips_->towards(flight.heading()));
    return slips_->in_contact(flight.pressed(), flight.heading(), function);
  }
  /// Calls `function(constants)` with those of free motion, or of motion in contact with a soft stop.
  template <class Function>
  decltype(auto) with_constants(Side pressed, Function&& function) const {
    return pressed == Side::none ? function(constants_) : soft_.with_constants(pressed, function);
  }

  /// The static level of friction less the force that pushes a mass that halts at a place to a side: friction holds it
  /// against that if it isn't negative.
  [[nodiscard]] Number left_to_level(const Standing<Number>& at, Side side) const {
    return p_.friction.static_level - sign_of(side) * force_on(at);
  }
  /// When dry friction lets a mass go that it holds.
  [[nodiscard]] const Releases<Number>& releases() const { return *releases_; }
  /// The phase at which motion begins after the event that a flight begins with.
  [[nodiscard]] Number start(const Flight<Number>& flight) const {
    if (flight.leaves != Event::Kind::stick) return flight.begin;
    const Standing<Number> at{flight.coordinate, flight.begin, flight.held_by};
    if (flight.from_crest) return flight.begin + releases_->hold_to_crest(at, flight.from);
    return flight.begin + releases_->hold_and_beyond(at, flight.from, Number(flight.end - flight.begin));
  }

  /// Calls `function(arc)` with the arc that a mass at a place goes on with, in contact with a soft stop or not.
  template <class Function>
  decltype(auto) with_arc_from(const Number& place, const Number& v, const Number& phase, Side pressed,
                               Function&& function) const {
    const Number x = p_.middle() + place;
    const Side beyond = pressed == Side::none ? damped_stop_beyond(x) : pressed;
    if (beyond == Side::none) return function(arc_from(constants_, x, v, phase));
    return with_constants(pressed, [&](const auto& constants) {
      const Number& stop = p_.position(beyond);
      return function(arc_beside(constants, stop, Number(x - stop), v, phase));
    });
  }
  /// The soft stop beyond whose place a mass is that it may be in contact with, or not: its damper relaxes slowly.
  [[nodiscard]] Side damped_stop_beyond(const Number& x) const {
    for (const Side side : {Side::lower, Side::upper})
      if (is_soft(p_.stops, side) && p_.soft_stop(side).damping != 0 && sign_of(side) * (x - p_.position(side)) > 0)
        return side;
    return Side::none;
  }

  /// Flies through stops, if it meets any.
  [[nodiscard]] FlightEnd<Number> fly(const Flight<Number>& flight) const {
    const Number time = (flight.end - start(flight)) / p_.oscillator.frequency;
    return with_arc(flight, [&](const auto& arc) { return end_of(arc, flight, time); });
  }
  /// The end of a flight a time after its beginning.
  template <class A>
  [[nodiscard]] FlightEnd<Number> end_of(const A& arc, const Flight<Number>& flight, const Number& time) const {
    if (flight.may_vanish(p_)) return fly_beyond(arc, flight, time);
    const motion::Motion<Number> end = arc.at(time);
    if (halts(flight.arrives)) return {end.v, Number(end.x - p_.middle())};
    const bool comes_back = flight.from == flight.to && !halts(flight.leaves);
    Number beyond = comes_back ? end.offset : Number(end.x - p_.position(flight.to));
    if (flight.arrives == Event::Kind::separation || flight.arrives == Event::Kind::renewal)
      beyond += p_.soft_stop(flight.to).relaxation() * end.v;
    return {beyond, end.v};
  }

  /// Motion without events less its mean: the response to each order of the force, free or in contact with a soft stop,
  /// by the phase of the force.
  [[nodiscard]] ForceOrders<Number> response(Side pressed) const {
    return with_constants(pressed, [&](const auto& constants) { return response_of(constants); });
  }
  /// Calls `function(arc)` with that motion from phase 0 on.
  template <class Function>
  decltype(auto) with_response(Side pressed, Function&& function) const {
    using std::cos, std::sin;
    return with_constants(pressed, [&](const auto& constants) {
      Number x = 0, v = 0;
      response_of(constants).each({sin(lead_), cos(lead_)}, [&](int j, const Number& value, const Number& slope) {
        x += value, v += static_cast<double>(j) * constants.nu * slope;
      });
      if (pressed == Side::none)
        return function(arc_from(constants_, Number(constants_.equilibrium + x), v, Number(0)));
      return function(arc_beside(constants, constants.origin, Number(constants.balance + x), v, Number(0)));
    });
  }

  /// Force on a mass that stands still at x.
  [[nodiscard]] Number force_at(const Number& x, const Number& phase) const {
    using std::cos, std::sin;
    return constants_.force({sin(phase + lead_), cos(phase + lead_)}) - constants_.spring(x);
  }

  /// The soft stop beyond whose position a mass halts.
  [[nodiscard]] Side soft_stop_around(const Number& place) const {
    return motion::soft_stop_around<Number>(p_.stops, Number(p_.middle() + place), Number(0)).side;
  }
  /// Force on a mass that halts.
  [[nodiscard]] Number force_on(const Standing<Number>& at) const {
    const Number force = clatter::force_at(constants_.f, p_.oscillator.shape, Number(at.phase + lead_)).value;
    return force + p_.standing_force(Number(p_.middle() + at.place), at.held_by);
  }
  /// Its acceleration as it slips towards a side.
  [[nodiscard]] Number acceleration(const Standing<Number>& at, Side side) const {
    return force_on(at) - sign_of(side) * p_.friction.kinetic;
  }

  /// Phase of the force less that of the shaking, rad.
  [[nodiscard]] const Number& lead() const { return lead_; }

 private:
  Flights(const SceneNumbers<Number>& parameters, const LeadingForce<Number>& force)
      : p_(parameters),
        lead_(force.lead),
        constants_(motion::ArcConstants<Number, E>::of(p_.oscillator.damping, force.amplitude, p_.oscillator.frequency,
                                                       p_.oscillator.load, p_.oscillator.stiffness,
                                                       p_.oscillator.shape)),
        soft_(constants_, p_.stops) {
    if (is_always_zero(p_.friction.kinetic)) return;
    slips_.emplace(constants_, p_.friction, p_.stops);
    releases_.emplace(p_, force);
  }

  /// The constants of motion towards a side.
  [[nodiscard]] const motion::ArcConstants<Number, E>& towards(Side side) const {
    return slips_ ? slips_->towards(side) : constants_;
  }

  template <Effects of>
  [[nodiscard]] static ForceOrders<Number> response_of(const motion::ArcConstants<Number, of>& c) {
    ForceOrders<Number> all;
    if constexpr (!of.stiffness) {
      const Response<Number> unit = steady_response(c.h, c.f, c.nu);
      all.of[0] = {unit.in_phase, unit.quadrature};
      return all;
    } else {
      for (std::size_t i = 0; i < all.of.size(); ++i) {
        const Number nu = static_cast<double>(i + 1) * c.nu;
        const ForceOrder<Number> sine{Number(1), Number(0)}, none{};
        const auto& [a, b] = c.has_orders() ? c.shape.orders.of[i] : i == 0 ? sine : none;
        if (is_always_zero(a) && is_always_zero(b)) continue;
        const Response<Number> unit = response_to(Number(c.k - nu * nu), c.h, c.f, nu);
        all.of[i] = {unit.in_phase * a - unit.quadrature * b, unit.in_phase * b + unit.quadrature * a};
      }
      return all;
    }
  }

  /// A contact with a soft stop, or an interruption of one. A short one is a Taylor polynomial, which keeps the digits
  /// of the force over the time, and goes on to times before the beginning: no motion, but Newton's method passes
  /// through there.
  template <class A>
  [[nodiscard]] FlightEnd<Number> fly_beyond(const A& arc, const Flight<Number>& flight, const Number& time) const {
    const Number relaxation = p_.soft_stop(flight.to).relaxation();
    const bool divided = flight.leaves != Event::Kind::touch || relaxation == 0;
    const motion::Motion<Number>& m = arc.start();
    if (time * arc.constants().rate > 1e-2) {
      const motion::Motion<Number> end = arc.at(time);
      const Number force = end.offset + relaxation * end.v;
      return {divided ? Number(force / time) : force, end.v};
    }
    constexpr std::size_t terms = 7;  // 1e-2^7 / 7! is rounding
    const auto& c = arc.constants();
    std::array<Number, terms + 1> x{Number(0), m.v, m.a};  // its derivatives, by eq. 3
    motion::with_force_terms<terms>(c, c.f, {m.sine, m.cosine}, Number(1), [&](auto&& force) {
      double factorial = 1;
      for (std::size_t k = 1; k + 2 <= terms; ++k) {
        factorial *= static_cast<double>(k);
        x[k + 2] = factorial * force(k) - 2 * c.h * x[k + 1] - c.spring(x[k]);
      }
    });
    Number mean = 0, mean_a = 0;  // of velocity and acceleration
    for (std::size_t k = terms; k-- > 1;) {
      const Number share = time / static_cast<double>(k + 1);
      mean = x[k] + share * mean, mean_a = x[k + 1] + share * mean_a;
    }
    const Number rate = mean + relaxation * mean_a;
    return {divided ? rate : Number(m.offset + relaxation * m.v + rate * time), m.v + mean_a * time};
  }

  [[nodiscard]] motion::Arc<Number, E> arc_from(const motion::ArcConstants<Number, E>& constants, const Number& x,
                                                const Number& v, const Number& phase) const {
    using std::cos, std::sin;
    const Number of_force = phase + lead_, sine = sin(of_force), cosine = cos(of_force);
    const Number a = constants.acceleration(Number(x - constants.equilibrium), v, {sine, cosine});
    return {constants, {Number(0), x, v, a, sine, cosine}};
  }
  /// At a release the acceleration is the difference of the levels of friction.
  template <Effects of>
  [[nodiscard]] motion::Arc<Number, of> arc_from_halt(const motion::ArcConstants<Number, of>& constants,
                                                      const Flight<Number>& flight) const {
    const Number x = p_.middle() + flight.coordinate;
    const motion::Arc<Number, of> arc = arc_beside(constants, x, Number(0), Number(0), start(flight));
    if (flight.leaves != Event::Kind::stick) return arc;
    motion::Motion<Number> released = arc.start();
    released.a = sign_of(flight.from) * (p_.friction.static_level - p_.friction.kinetic);
    return {arc.constants(), released, x};
  }
  /// An arc that begins a little way off a soft stop.
  template <Effects of>
  [[nodiscard]] motion::Arc<Number, of> arc_beside(const motion::ArcConstants<Number, of>& constants,
                                                   const Number& stop, const Number& offset, const Number& v,
                                                   const Number& phase) const {
    using std::cos, std::sin;
    const Number of_force = phase + lead_, sine = sin(of_force), cosine = cos(of_force), x = stop + offset;
    const Number a = constants.acceleration(constants.from_equilibrium(x, stop, offset), v, {sine, cosine});
    return {constants, {offset, x, v, a, sine, cosine}, stop};
  }

  SceneNumbers<Number> p_;
  Number lead_;
  motion::ArcConstants<Number, E> constants_;
  motion::SoftContact<Number> soft_;
  std::optional<motion::Slips<Number, E>> slips_{};  ///< with dry friction
  std::optional<Releases<Number>> releases_{};       ///< likewise
};

}  // namespace clatter::branches
