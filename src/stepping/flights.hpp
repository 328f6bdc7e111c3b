#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/contact.hpp"
#include "stepping/integrator.hpp"

namespace clatter::stepping {

/// An arc and its end: the first of its margins that falls to 0, else the horizon, or an earlier instant if the method
/// divides the flight into several arcs.
template <class A>
struct ArcToEvent {
  A arc;
  motion::Crossing<typename A::Number> crossing{};
};

/// The same of a loose mass in its housing; the arc knows that of the main mass.
template <class A>
struct FlightInHousing {
  A arc;
  motion::Crossing<typename A::Number> contact{};  ///< its motion is that in the housing
};

/// A wall that presses a loose mass.
template <class Number>
struct Pressing {
  Side wall;    ///< none: whatever its force is, nothing ends the time
  Number load;  ///< y'' of the loose mass alone
};

/// Flights of the event loop, each by the method: `fly(state, motion, anchor, horizon)` between rigid stops, and
/// `fly_within(constants, state, motion, anchor, margins, horizon)` up to the first of some margins that falls to 0;
/// with a loose mass `fly_in_housing(state, motion, anchor, start, walls, horizon)` up to its next impact, and
/// `carry(constants, state, motion, anchor, pressing, horizon)` of both masses as one.
template <class Method, class N, Effects E>
class Flights : public IntegratorBase<N, E> {
  using Base = IntegratorBase<N, E>;

 public:
  using Number = N;
  using Base::Base;

 protected:
  [[nodiscard]] Method& method() { return static_cast<Method&>(*this); }

  /// The position that the offset of the present flight counts from.
  [[nodiscard]] Number anchor(const motion::State<Number>& state) const {
    return state.from_stop == Side::none ? state.x : motion::stop_at<Number>(this->stops(), state.from_stop).position;
  }
  /// The beginning of a flight; `released`: the acceleration if it begins with a release.
  template <class Constants>
  [[nodiscard]] motion::Motion<Number> motion(const Constants& constants, const motion::State<Number>& state,
                                              const Number& released = Number(0)) const {
    const auto [sine, cosine] = this->phase(state);
    const Number offset = state.from_stop == Side::none ? Number(0) : state.offset;
    const Number displacement = constants.from_equilibrium(state.x, anchor(state), offset);
    const Number a = state.released ? released : constants.acceleration(displacement, state.v, sine);
    return {offset, state.x, state.v, a, sine, cosine};
  }

  /// The longest time after which a mass that a stop or a wall lets go, and that is back, may never have been let go:
  /// a force that touches zero differs from zero so long by no more than the rounding of its parts, some ulps of each.
  [[nodiscard]] Number shortest_hop() const {
    using std::sqrt;
    return 4 * sqrt(epsilon<Number>()) * 2 * pi<Number>() / this->constants().rate;
  }

  /// Whether a mass that a rigid stop lets go is back at once: the pressing force touches zero, and has lost its digits
  /// in the difference of the load and the spring.
  [[nodiscard]] bool is_hop(const motion::State<Number>& state, const motion::Crossing<Number>& contact) const {
    using std::abs, std::sqrt;
    if (E.forcing == Forcing::none || !E.rest || state.v != 0 || state.offset != 0) return false;
    if (state.from_stop != contact.side || is_soft(this->stops(), contact.side)) return false;
    const auto& c = this->constants();
    const Number of_all = abs(c.f) + abs(c.load) + abs(c.spring(state.x)), hop = shortest_hop();
    const Number most = Number(1024);  // a force that hardly changes beside the others touches zero nowhere
    return contact.elapsed <= most * hop && contact.elapsed * sqrt(abs(c.f)) <= hop * sqrt(of_all);
  }

  void pass(motion::State<Number>& state, const Number& elapsed) const {
    state.phase_turns += elapsed / this->period();
  }
  [[nodiscard]] static Outcome outcome_at(const motion::Crossing<Number>& crossing) {
    if (crossing.resolved) return Outcome::completed;
    return Base::finite(crossing.motion.x) ? Outcome::unresolved : Outcome::not_finite;
  }

  /// The constant force and f sin(theta) on a mass at x' = 0.
  [[nodiscard]] Number push(const motion::State<Number>& state) const requires(E.friction) {
    return this->holding_at(state).constant + this->constants().f * this->phase(state).sine;
  }
  /// The side that a mass slips to: that of its velocity, or that to which it is pushed, or let go.
  [[nodiscard]] Side heading(const motion::State<Number>& state) const requires(E.friction) {
    const Number way = state.v != 0     ? state.v
                       : state.released ? Number(this->constants().f * this->phase(state).cosine)
                                        : push(state);
    return way > 0 ? Side::upper : Side::lower;
  }
  /// Stops a mass that creeps: without a force, heavy damping lets it come ever closer to the place at which friction
  /// holds it. Once the way left and the acceleration are below rounding it is there, within the level of friction.
  void end_creep(motion::State<Number>& state) const requires(E.friction) {
    using std::abs;
    if (state.v == 0 || this->constants().f != 0) return;
    const Side ahead = heading(state);
    const auto stop_on_way = [&](const auto& slip) {
      if (!(slip.k > 0) || slip.h * slip.h < slip.k) return;
      const Number size = abs(state.x) + (abs(this->constants().load) + this->slips().kinetic) / slip.k;
      const Number left = sign_of(ahead) * push(state) - this->slips().kinetic, rounding = 4 * epsilon<Number>() * size;
      if (!(2 * slip.h * abs(state.v) <= slip.k * rounding && abs(left) <= slip.k * rounding)) return;
      state.v = 0, state.x += sign_of(ahead) * 2 * rounding, state.offset += sign_of(ahead) * 2 * rounding;
    };
    if (state.pressed)
      this->slips().in_contact(state.within, ahead, stop_on_way);
    else
      stop_on_way(this->slips().towards(ahead));
  }

  /// The gap to the stop ahead, and the velocity.
  [[nodiscard]] std::array<motion::Margin<Number>, 2> slip_margins(const motion::State<Number>& state,
                                                                   Side ahead) const {
    const Number one(sign_of(ahead)), position(ahead == Side::upper ? this->stops().upper : this->stops().lower);
    return {motion::Margin<Number>{one * (position - anchor(state)), -one, Number(0)},
            motion::Margin<Number>{Number(0), Number(0), one}};
  }

  /// Whether the velocity of a slip falls to 0, perhaps with the horizon.
  [[nodiscard]] static bool is_still(const motion::Crossing<Number>& crossing) {
    return crossing.margin == 1 || (crossing.margin > 1 && crossing.motion.v == 0);
  }
  /// Of the gap to a rigid stop at the end of a slip. Without a spring, and with a force that is the same both ways, a
  /// mass that a stop has released comes back to it exactly without speed: it then rests, whatever rounding says. A
  /// flight that a section cuts has its rounding from the beginning.
  [[nodiscard]] Number rounding_of_gap(motion::State<Number>& state, const motion::Stop<Number>& stop) const {
    using std::abs, std::max;
    const bool begins = state.v == 0 || (state.from_stop != Side::none && state.offset == 0);
    const bool may_touch = !is_soft(this->stops(), stop.side) && this->finite(stop.position);
    if (begins || !may_touch) state.reach = Number(0);
    if (!may_touch) return Number(0);
    const Number way = state.from_stop == stop.side ? Number(abs(state.offset))
                                                    : Number(abs(stop.position - state.x) + abs(stop.position));
    state.reach = max(state.reach, way);
    return 64 * epsilon<Number>() * state.reach;
  }

  /// One arc with these constants, up to the first margin that falls to 0.
  template <class Constants, std::size_t count, class Observer>
  motion::Crossing<Number> cross(const Constants& constants, motion::State<Number>& state,
                                 const std::array<motion::Margin<Number>, count>& margins, const Number& end,
                                 std::int64_t origin, Observer& observer, const Number& released = Number(0)) {
    const motion::Motion<Number> start = motion(constants, state, released);
    const Number horizon = (end - state.phase_turns) * this->period();
    const auto [arc, crossing] = method().fly_within(constants, state, start, anchor(state), margins, horizon);
    if (!crossing.resolved) return crossing;
    if constexpr (E.friction)  // a slip that ends where it begins is none
      if (this->is_rough() && crossing.elapsed == 0 && state.v == 0) return crossing;
    observer.arc(arc, this->time(state, origin), static_cast<double>(crossing.elapsed));
    pass(state, crossing.elapsed);
    state.x = crossing.motion.x, state.v = crossing.motion.v, state.offset = crossing.motion.offset;
    return crossing;
  }
};

}  // namespace clatter::stepping
