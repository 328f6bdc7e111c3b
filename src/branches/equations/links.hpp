#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "branches/equations/equations.hpp"
#include "math/dual.hpp"

/// How small changes spread from event to event of a motion; for the equations and the maps.
namespace clatter::branches::detail {

/// Derivatives by phase and velocity at the beginning of a flight, by the phase at its end, and by two parameters.
constexpr std::size_t by_begin = 0, by_before = 1, by_end = 2, by_first_axis = 3, most_variables = 5;
using First = Dual<double, most_variables>;
using Second = Dual<First, 3>;  // of the first three, each with its derivatives by all of them

/// The variable that one of a flight's first three derivatives belongs to; in numbers without derivatives its value.
template <class Number>
Number variable(double value, std::size_t index) {
  if constexpr (std::is_same_v<Number, double>)
    return value;
  else if constexpr (std::is_same_v<Number, Second>)
    return {First(value, index), index};
  else
    return {value, index};
}

template <class Number>
Flight<Number> flight_of(const Orbit& orbit, std::size_t i) {
  const OrbitEvent from = orbit.event(i), to = orbit.event(i + 1);
  return {from.side,
          variable<Number>(from.phase, by_begin),
          variable<Number>(from.coordinate(), by_before),
          to.side,
          variable<Number>(to.phase, by_end),
          from.kind,
          to.kind,
          false,
          from.held_by()};
}

/// A variable that a scene's parameter is, in numbers with derivatives by it.
template <class Number>
Number variable_of_axis(double value, std::size_t axis) {
  if constexpr (std::is_same_v<Number, Second>)
    return Number(First(value, by_first_axis + axis));
  else
    return Number(value, by_first_axis + axis);
}

/// The numbers of a scene, with derivatives by the parameters that vary.
template <class Number>
SceneNumbers<Number> numbers_along(const FollowedScene& scene, const std::vector<OrbitEquations::Axis>& axes) {
  return numbers_of<Number>(scene, [&](BasicGivenScene<Number>& given) {
    for (std::size_t k = 0; k < axes.size(); ++k)
      set(given, axes[k].parameter, variable_of_axis<Number>(value_of(scene, axes[k].parameter), k));
  });
}

template <class Number>
using Square = std::array<std::array<Number, 2>, 2>;

template <class A, class B>
auto product(const Square<A>& a, const Square<B>& b) {
  Square<decltype(a[0][0] * b[0][0])> c;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return c;
}

/// One flight's derivative of the next event by the last, times the denominator.
template <class Number>
struct Link {
  Square<Number> numerator;
  Number denominator;
};

/// From derivatives of gap and velocity, or at a halt of velocity and place, by the beginning's phase and velocity and
/// by the end's phase. The mirrored orbit's last flight ends in the mirror image of its first event. A stick's phase
/// changes nothing, and its place, at which the velocity is 0, doesn't depend on it: so a stick without a length has a
/// link, too, though the mass isn't slowed down there.
template <class Number>
Link<Number> link_of(const std::array<Number, 3>& x, const std::array<Number, 3>& v, bool mirrored,
                     Event::Kind arrives) {
  Link<Number> link{{{{-x[0], -x[1]}, {x[2] * v[0] - v[2] * x[0], x[2] * v[1] - v[2] * x[1]}}}, x[2]};
  if (arrives == Event::Kind::stick) link = {{{{Number(0), Number(0)}, {v[0], v[1]}}}, Number(1)};
  if (mirrored) link.numerator[1] = {-link.numerator[1][0], -link.numerator[1][1]};
  return link;
}

/// The map of an orbit as it is kept, from its links.
inline ImpactMap map_of(const std::vector<Link<double>>& links, double determinant) {
  ImpactMap map{.determinant = determinant};
  Square<double> matrix{{{1, 0}, {0, 1}}};
  for (const Link<double>& link : links) matrix = product(link.numerator, matrix), map.denominator *= link.denominator;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) map.numerator[i][j] = matrix[i][j];
  return map;
}

/// The acceleration after a reversal, towards a side, over that before (eq. 64).
template <class Number>
Number reversal_factor(const SceneNumbers<Number>& p, Side to, const Standing<Number>& at) {
  const Number push = p.force_at(at.phase).value + p.standing_force(Number(p.middle() + at.place), at.held_by),
               rubs = sign_of(to) * p.friction.kinetic;
  return (push - rubs) / (push + rubs);
}

/// By how much the velocity after a stick changes with its place (eq. 65).
template <class Number, Effects E>
Number release_factor(const Flights<Number, E>& flights, const Flight<Number>& flight) {
  const SceneNumbers<Number>& p = flights.parameters();
  const Number a = sign_of(flight.from) * (p.friction.static_level - p.friction.kinetic);
  if (a == 0) return a;
  Number k = p.oscillator.stiffness;
  if (flight.held_by != Side::none) k += p.soft_stop(flight.held_by).stiffness;
  return -a * k / (p.oscillator.frequency * p.force_at(flights.start(flight)).slope);
}

/// The derivative of a flight's end by the state before the event that it begins with (eqs. 7, 27, 53, 64 and 65),
/// times the speed before a rigid impact.
template <class Number, Effects E>
Link<Number> link_of_states(const Flights<Number, E>& flights, const Flight<Number>& flight, bool mirrored) {
  const SceneNumbers<Number>& p = flights.parameters();
  Link<Number> link{{{{Number(1), Number(0)}, {Number(0), Number(1)}}}, Number(1)};
  if (flight.leaves == Event::Kind::impact) {
    const Restitution<Number> law = p.law(flight.from);
    const Number &v = flight.coordinate, &h = p.oscillator.damping, share = law.share(v), slope = law.derivative(v);
    const Number force = flights.force_at(p.position(flight.from), flight.begin),
                 rubs = sign_of(flight.from) * p.friction.kinetic, before = force - 2 * h * v - rubs,
                 after = force + 2 * h * share * v + rubs;
    link.numerator = {{{-share * v, Number(0)}, {after - slope * before, slope * v}}};
    link.denominator = v;
  } else if (flight.leaves == Event::Kind::touch) {
    link.numerator[1][0] = -2 * p.soft_stop(flight.from).damping;
  } else if (flight.leaves == Event::Kind::reversal) {
    link.numerator[1][1] =
        reversal_factor(p, flight.from, Standing<Number>{flight.coordinate, flight.begin, flight.held_by});
  } else if (flight.leaves == Event::Kind::stick) {
    link.numerator[1] = {release_factor(flights, flight), Number(0)};
  }
  const Number time = (flight.end - flights.start(flight)) / p.oscillator.frequency;
  flights.with_constants(flight, [&](const auto& constants) {
    const motion::Propagator<Number> free = constants.propagator(time);
    const Number sign = mirrored ? -1 : 1;
    const Square<Number> flown{{{sign * free.a, sign * free.b}, {-sign * constants.spring(free.b), sign * free.c}}};
    link.numerator = product(flown, link.numerator);
  });
  return link;
}

template <class Number>
std::vector<Link<Number>> links_of_states(const FollowedScene& scene, const Orbit& orbit, const SceneNumbers<Number>& p,
                                          bool stiffness_varies) {
  std::vector<Link<Number>> links;
  with_arcs(
      scene,
      [&]<Effects E>() {
        const Flights<Number, E> flights(p);
        for (std::size_t i = 0; i < orbit.size(); ++i)
          links.push_back(link_of_states(flights, flight_of<Number>(orbit, i), orbit.ends_mirrored(i)));
      },
      stiffness_varies);
  return links;
}

/// R^(2n) e^(-2 h T) of the impacts of an orbit as it is kept, less by e^(-2 h_s t) in a contact with a soft stop, by
/// the accelerations after and before each reversal; 0 with a stick.
template <class Number>
Number determinant_of(const SceneNumbers<Number>& p, const Orbit& orbit) {
  using std::exp;
  Number determinant = exp(Number(-2) * p.oscillator.damping * (Number(orbit.advance()) / p.oscillator.frequency));
  const auto press = [&](Side side, double advance) {
    determinant *= exp(Number(-2) * p.soft_stop(side).damping * (Number(advance) / p.oscillator.frequency));
  };
  if (orbit.pressed != Side::none && orbit.size() == 0) press(orbit.pressed, orbit.advance());
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent& event = orbit.events[i];
    if (is_impact(event.kind)) {
      const Number v(event.before);
      const Restitution<Number> law = law_at(p, event.kind, event.side);
      determinant *= -law.share(v) * law.derivative(v);
    }
    if (const Side side = orbit.pressed_after(i); side != Side::none)
      press(side, orbit.event(i + 1).phase - event.phase);
    if (event.kind == Event::Kind::stick) determinant = Number(0);
    if (event.kind == Event::Kind::reversal)
      determinant *=
          reversal_factor(p, event.side, Standing<Number>{Number(event.place), Number(event.phase), event.held_by()});
  }
  return determinant;
}

}  // namespace clatter::branches::detail
