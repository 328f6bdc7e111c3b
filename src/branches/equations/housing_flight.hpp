#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "branches/equations/flight.hpp"
#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"

namespace clatter::branches {

/// Calls `function.operator()<E>()` with the effects of the arcs of a main mass: those of any stiffness, which have
/// derivatives by it, too.
template <class Function>
decltype(auto) with_arcs_of_main(const Scene& scene, Function&& function) {
  return with_smooth_effects<true>(oscillator_in_frame(scene), std::forward<Function>(function));
}

/// Whether nothing holds a main mass somewhere: no spring, and no stop that it meets.
[[nodiscard]] inline bool is_anywhere(const Scene& scene, const Orbit& orbit) {
  return has_loose_mass(scene.loose) && scene.oscillator.stiffness == 0 && !orbit.meets_stops();
}

/// A flight of two masses from an event of one of them, with that one's numbers as `OrbitEvent` has them, to another.
template <class Number>
struct FlightOfBoth {
  Event::Kind leaves = Event::Kind::strike, arrives = Event::Kind::strike;
  Side from, to;
  Number begin, coordinate, other_place, other_before, end;
  Side pressed = Side::none;  ///< the soft stop that the main mass is in contact with

  /// That of the main mass alone. From a strike it begins where the mass just is, in contact or not.
  [[nodiscard]] Flight<Number> of_main(Side beside) const {
    return {leaves == Event::Kind::strike ? beside : from, begin, coordinate, to, end, leaves, arrives};
  }
};

/// That of an orbit; `number(value, i)` makes the numbers of the event that it begins with, 0 ... 3, and the phase at
/// its end, 4.
template <class Number, class Make>
[[nodiscard]] FlightOfBoth<Number> flight_of_both(const Orbit& orbit, std::size_t i, const Make& number) {
  const OrbitEvent from = orbit.event(i), to = orbit.event(i + 1);
  return {from.kind,
          to.kind,
          from.side,
          to.side,
          number(from.phase, 0),
          number(from.coordinate(), 1),
          number(from.other.place, 2),
          number(from.other.before, 3),
          number(to.phase, 4),
          orbit.pressed_after(i)};
}
[[nodiscard]] inline FlightOfBoth<double> flight_of_both(const Orbit& orbit, std::size_t i) {
  return flight_of_both<double>(orbit, i, [](double value, std::size_t) { return value; });
}

/// The flights of a loose mass in its housing, and of the main mass beside it, at given parameters (eqs. 68 and 70).
/// Arcs refer to it.
template <class Number, Effects E>
class HousingFlights {
 public:
  explicit HousingFlights(const SceneNumbers<Number>& parameters) : main_(parameters) {}

  [[nodiscard]] const motion::ArcConstants<Number, E>& constants() const { return main_.constants(); }
  [[nodiscard]] const SceneNumbers<Number>& parameters() const { return main_.parameters(); }
  [[nodiscard]] const Flights<Number, E>& of_main() const { return main_; }

  /// Calls `function(arc)` with the flight of the loose mass, which has that of the main mass.
  template <class Function>
  decltype(auto) with_arc(const FlightOfBoth<Number>& flight, Function&& function) const {
    const auto& p = parameters();
    if (flight.leaves == Event::Kind::strike) {
      const motion::WallRule<Number> rule(p.loose);
      const Number v = rule.main_after(flight.other_before, flight.coordinate),
                   w = rule.law(flight.from).after(flight.coordinate);
      return main_.with_arc_from(flight.other_place, v, flight.begin, flight.pressed, [&](const auto& main) {
        return function(motion::RelativeArc(main, {wall(flight.from), Number(0), w, Number(w + v)}, p.loose.load));
      });
    }
    const Number before = halts(flight.leaves) ? Number(0) : flight.coordinate, v = before + flight.other_before,
                 z = p.middle_of_walls() + flight.other_place;
    return main_.with_arc(flight.of_main(Side::none), [&](const auto& main) {
      return function(motion::RelativeArc(main, {Number(0), z, Number(v - main.start().v), v}, p.loose.load));
    });
  }

  /// The end of a flight as `OrbitEvent` has it, with how far it is beyond its stop or wall in place of the phase. It
  /// goes through others, if it meets any.
  [[nodiscard]] std::array<Number, 4> end(const FlightOfBoth<Number>& flight) const {
    const Number time = (flight.end - flight.begin) / parameters().oscillator.frequency;
    return with_arc(flight, [&](const auto& arc) -> std::array<Number, 4> {
      const motion::Motion<Number> m = at(arc, time);
      if (flight.arrives == Event::Kind::strike) {
        const motion::Motion<Number> main = arc.main_at(m);
        const bool comes_back = flight.leaves == Event::Kind::strike && flight.from == flight.to;
        const Number beyond = comes_back ? m.offset : Number((arc.anchor() - wall(flight.to)) + m.offset);
        return {beyond, m.v, main.x - parameters().middle(), main.v};
      }
      const FlightEnd<Number> main = main_.end_of(arc.main(), flight.of_main(beside(flight)), time);
      return {main.beyond, main.coordinate, m.x - parameters().middle_of_walls(), m.v};
    });
  }
  /// The stop that the arc of the main mass counts from, if a flight begins with a strike.
  [[nodiscard]] Side beside(const FlightOfBoth<Number>& flight) const {
    if (flight.pressed != Side::none) return flight.pressed;
    return main_.damped_stop_beyond(Number(parameters().middle() + flight.other_place));
  }

 private:
  [[nodiscard]] const Number& wall(Side side) const {
    return side == Side::upper ? parameters().loose.upper : parameters().loose.lower;
  }
  /// Motion on an arc, which Newton's method may ask for before its beginning, if a flight is about to vanish.
  template <class A>
  [[nodiscard]] static motion::Motion<Number> at(const A& arc, const Number& time) {
    if (time > 0) return arc.at(time);
    motion::Motion<Number> m = arc.start();
    m.offset += m.v * time, m.x += m.v * time, m.v += m.a * time;
    return m;
  }

  Flights<Number, E> main_;
};

}  // namespace clatter::branches
