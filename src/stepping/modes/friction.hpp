#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "motion/dry_friction.hpp"
#include "stepping/laws.hpp"
#include "stepping/modes/mode.hpp"
#include "stepping/modes/release.hpp"

namespace clatter::stepping {

namespace modes {

/// The constant force and f sin(theta) on a mass at x' = 0.
template <class Loop, class State>
[[nodiscard]] auto push(const Loop& loop, const State& state) {
  using Number = typename Loop::Number;
  return Number(loop.holding_at(state).constant + loop.constants().f * loop.constants().drive(loop.phase(state)).sine);
}
/// The rate of these forces.
template <class Loop, class State>
[[nodiscard]] auto rate_of_push(const Loop& loop, const State& state) {
  using Number = typename Loop::Number;
  const auto& c = loop.constants();
  if constexpr (requires { loop.walls(); })
    if (!Loop::carries && state.loose.pushed)
      return Number(c.f * c.nu * c.drive(loop.phase(state)).cosine + loop.walls().rate_of_push(state.loose));
  return Number(c.f * c.drive(loop.phase(state)).cosine);
}
/// The side that a mass slips to: that of its velocity, or that to which it is pushed, or let go.
template <class Loop, class State>
[[nodiscard]] Side heading(const Loop& loop, const State& state) {
  using Number = typename Loop::Number;
  const Number way = state.v != 0 ? state.v : state.released ? rate_of_push(loop, state) : push(loop, state);
  return way > 0 ? Side::upper : Side::lower;
}
/// Calls `function(constants)` with those of a slip towards a side.
template <class Loop, class State, class Function>
decltype(auto) with_slip(const Loop& loop, const State& state, Side ahead, Function&& function) {
  if (state.pressed) return loop.slips().in_contact(state.within, ahead, function);
  return function(loop.slips().towards(ahead));
}
/// Stops a mass that creeps: without a force, heavy damping lets it come ever closer to the place at which friction
/// holds it. Once the way left and the acceleration are below rounding it is there, within the level of friction.
template <class Loop, class State>
void end_creep(const Loop& loop, State& state) {
  using std::abs;
  using Number = typename Loop::Number;
  if (state.v == 0 || loop.constants().f != 0) return;
  const Side ahead = heading(loop, state);
  with_slip(loop, state, ahead, [&](const auto& slip) {
    if (!(slip.k > 0) || slip.h * slip.h < slip.k) return;
    const Number kinetic = loop.slips().kinetic;
    const Number size = abs(state.x) + (abs(loop.constants().load) + kinetic) / slip.k;
    const Number left = sign_of(ahead) * push(loop, state) - kinetic, rounding = 4 * epsilon<Number>() * size;
    if (!(2 * slip.h * abs(state.v) <= slip.k * rounding && abs(left) <= slip.k * rounding)) return;
    state.v = 0, state.x += sign_of(ahead) * 2 * rounding, state.offset += sign_of(ahead) * 2 * rounding;
  });
}

/// The gap to the stop ahead of a slip, as a margin.
template <class Loop, class State>
[[nodiscard]] auto gap_ahead(const Loop& loop, const State& state, Side ahead) {
  using Number = typename Loop::Number;
  const Number one(sign_of(ahead)), position = motion::stop_at<Number>(loop.stops(), ahead).position;
  return motion::Margin<Number>{one * (position - loop.anchor(state)), -one, Number(0)};
}
/// The velocity towards a side, as a margin.
template <class Number>
[[nodiscard]] motion::Margin<Number> speed_towards(Side side) {
  return {Number(0), Number(0), Number(sign_of(side))};
}

}  // namespace modes

/// Dry friction holds the mass, on a stop or anywhere.
template <class Loop>
struct Stuck {
  static constexpr Row row{"stick", "held by friction, at any place", "the level of friction", Search::closed_form,
                           "release"};
  static constexpr bool called_for = Loop::effects.friction;
  using Number = typename Loop::Number;
  using Holding = motion::Holding<Number>;

  [[nodiscard]] static std::optional<Holding> has(const Loop& loop, const motion::State<Number>& state) {
    return loop.is_rough() ? loop.held(state) : std::nullopt;
  }
  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage, const Holding& holding) {
    auto& state = stage.state;
    if (holding.stop != Side::none) state.from_stop = holding.stop, state.offset = 0;
    if constexpr (modes::may_meet_soft_walls<Loop>)
      if (state.loose.within)
        return modes::stay_at_wall(loop, stage, holding.stop, std::optional(holding), stage.end, true);
    std::optional<Number> first;
    for (const Side side : {Side::lower, Side::upper})
      if (const auto release = modes::upcoming(
              modes::in_section(
                  loop, holding.release_phase(loop.constants(), side, Number(loop.start_turns() + state.phase_turns))),
              state.phase_turns, first ? *first : stage.end))
        first = release;
    return laws::hold(loop, stage, holding.stop, first);
  }
};

/// A slip of a mass to one side.
template <class Loop>
struct AnySlip {
  using Number = typename Loop::Number;
  using Crossing = motion::Crossing<Number>;

  AnySlip(Loop& loop_, motion::State<Number>& state_) : loop(loop_), state(state_) {}

  Loop& loop;
  motion::State<Number>& state;
  Side ahead = modes::heading(loop, state);
  bool begins = state.v == 0;

  [[nodiscard]] Number release_acceleration() const { return loop.slips().release_acceleration(ahead); }
  /// So short a slip to rest would end at the phase that it begins with.
  [[nodiscard]] bool is_none(const Crossing& crossing) const {
    if (!begins || crossing.margin > 1) return false;
    const Number least = crossing.margin == 1 ? Number(epsilon<Number>() * loop.constants().period) : Number(0);
    return crossing.elapsed <= least;
  }
  /// The mass would meet at once what is ahead, or stop again: it enters the soft stop that it is on, else the force is
  /// within rounding of the level of friction, and it waits.
  template <class Stage>
  [[nodiscard]] Outcome wait(Stage& stage, const Crossing&) const {
    const auto position = motion::stop_at<Number>(loop.stops(), ahead).position;
    if (state.within == Side::none && is_soft(loop.stops(), ahead) && state.x == position) {
      laws::enter(state, ahead);
      return Outcome::completed;
    }
    return laws::wait(loop, stage, loop.holding_at(state).stop);
  }
  /// Whether the velocity, the second margin, has fallen to 0, perhaps with the horizon.
  [[nodiscard]] static bool is_still(const Crossing& crossing) {
    return crossing.margin == 1 || (crossing.margin > 1 && crossing.motion.v == 0);
  }
  /// The mass sticks, as the next mode finds, or moves back at once.
  template <class Stage>
  void turn(Stage& stage) const {
    state.v = 0;
    if (loop.held(state) || modes::heading(loop, state) == ahead) return;
    const Number push = modes::push(loop, state), rubs = sign_of(ahead) * loop.slips().kinetic;
    stage.show_reversal(Number(push - rubs), Number(push + rubs));
  }
};

/// Slips until it meets the stop ahead, or its velocity falls to 0.
template <class Loop>
struct Slip : AnySlip<Loop> {
  static constexpr Row row{"slip", "free, its load moved against the velocity", "gap to the stop ahead; velocity",
                           Search::margins, "impact or touch; stick or reversal"};
  static constexpr bool called_for = Stuck<Loop>::called_for;
  using typename AnySlip<Loop>::Number;
  using AnySlip<Loop>::AnySlip;
  using AnySlip<Loop>::loop, AnySlip<Loop>::state, AnySlip<Loop>::ahead;

  motion::Stop<Number> stop = motion::stop_at<Number>(loop.stops(), ahead);
  Number rounding = rounding_of_gap();
  std::array<motion::Margin<Number>, 2> guards{modes::gap_ahead(loop, state, ahead),
                                               modes::speed_towards<Number>(ahead)};

  [[nodiscard]] static bool has(const Loop& loop, const motion::State<Number>&) { return loop.is_rough(); }

  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    return function(loop.slips().towards(ahead));
  }
  [[nodiscard]] const auto& margins() const { return guards; }

  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    const auto& crossing = flown.crossing;
    state.released = false;
    const bool still = this->is_still(crossing), touches = still && guards[0].of(crossing.motion) <= rounding;
    if (still && !touches) this->turn(stage);
    if (crossing.margin != 0 && !touches) return Outcome::completed;
    state.x = stop.position;
    const Number brakes = -stop.into(crossing.motion.a), speed = stop.into(state.v);
    if (touches || speed < 0 || speed * speed <= 2 * brakes * rounding) state.v = 0;
    return laws::meet(loop, stage, stop);
  }

 private:
  /// Of the gap to a rigid stop at the end of a slip. Without a spring, and with a force that is the same both ways, a
  /// mass that a stop has released comes back to it exactly without speed: it then rests, whatever rounding says. A
  /// flight that a section cuts has its rounding from the beginning.
  [[nodiscard]] Number rounding_of_gap() const {
    using std::abs, std::max;
    const bool is_first = this->begins || (state.from_stop != Side::none && state.offset == 0);
    const bool may_touch = !is_soft(loop.stops(), stop.side) && loop.finite(stop.position);
    if (is_first || !may_touch) state.reach = Number(0);
    if (!may_touch) return Number(0);
    const Number way = state.from_stop == stop.side ? Number(abs(state.offset))
                                                    : Number(abs(stop.position - state.x) + abs(stop.position));
    state.reach = max(state.reach, way);
    return 64 * epsilon<Number>() * state.reach;
  }
};

/// Slips in contact with a soft stop until the force of that, or the velocity, falls to 0.
template <class Loop>
struct SlipInContact : AnySlip<Loop> {
  static constexpr Row row{"slip in contact", "the same, with the soft stop", "force of the stop; velocity",
                           Search::margins, "separation; stick or reversal"};
  static constexpr bool called_for = Stuck<Loop>::called_for && Loop::effects.soft;
  using typename AnySlip<Loop>::Number;
  using AnySlip<Loop>::AnySlip;
  using AnySlip<Loop>::loop, AnySlip<Loop>::state, AnySlip<Loop>::ahead;

  motion::SoftStop<Number> stop = motion::soft_stop_at<Number>(loop.stops(), state.within);

  [[nodiscard]] static bool has(const Loop& loop, const motion::State<Number>& state) {
    return loop.is_rough() && state.pressed;
  }

  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    return loop.slips().in_contact(stop.side, ahead, function);
  }
  [[nodiscard]] auto margins() const { return std::array{modes::force_of(stop), modes::speed_towards<Number>(ahead)}; }

  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    state.released = false;
    if (flown.crossing.margin == 0) laws::separate(stage, stop);
    if (this->is_still(flown.crossing)) this->turn(stage);
    return Outcome::completed;
  }
};

}  // namespace clatter::stepping
