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
  return Number(loop.holding_at(state).constant + loop.constants().f * loop.phase(state).sine);
}
/// The side that a mass slips to: that of its velocity, or that to which it is pushed, or let go.
template <class Loop, class State>
[[nodiscard]] Side heading(const Loop& loop, const State& state) {
  using Number = typename Loop::Number;
  const Number way = state.v != 0     ? state.v
                     : state.released ? Number(loop.constants().f * loop.phase(state).cosine)
                                      : push(loop, state);
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
/// Whether the velocity of a slip, its second margin, falls to 0, perhaps with the horizon.
template <class Number>
[[nodiscard]] bool is_still(const motion::Crossing<Number>& crossing) {
  return crossing.margin == 1 || (crossing.margin > 1 && crossing.motion.v == 0);
}
template <class Number>
[[nodiscard]] bool ends_at_once(const motion::Crossing<Number>& crossing) {
  return crossing.margin < 2 && crossing.elapsed == 0;
}
/// Ends a slip towards a side: the mass sticks, as the next mode finds, or moves back at once.
template <class Loop, class Stage>
void turn(const Loop& loop, Stage& stage, Side ahead) {
  using Number = typename Loop::Number;
  auto& state = stage.state;
  state.v = 0;
  if (loop.held(state) || heading(loop, state) == ahead) return;
  const Number pushed = push(loop, state), rubs = sign_of(ahead) * loop.slips().kinetic;
  stage.show_reversal(Number(pushed - rubs), Number(pushed + rubs));
}
/// A mass without speed that would meet at once what is ahead: it enters the soft stop that it is on, else the force
/// is within rounding of the level of friction, and it waits.
template <class Loop, class Stage>
[[nodiscard]] Outcome begin_slip_anew(const Loop& loop, Stage& stage, Side ahead) {
  auto& state = stage.state;
  const auto position = motion::stop_at<typename Loop::Number>(loop.stops(), ahead).position;
  if (state.within == Side::none && is_soft(loop.stops(), ahead) && state.x == position) {
    laws::enter(state, ahead);
    return Outcome::completed;
  }
  return laws::wait(stage, loop.holding_at(state).stop);
}

}  // namespace modes

/// Dry friction holds the mass, on a stop or anywhere.
template <class Loop>
struct Stuck {
  static constexpr Row row{"stick", "held by friction, at any place", "the level of friction", Search::closed_form,
                           "release"};
  static constexpr bool called_for = Loop::effects.friction && !Loop::effects.loose;
  using Number = typename Loop::Number;
  using Holding = motion::Holding<Number>;

  [[nodiscard]] static std::optional<Holding> has(const Loop& loop, const motion::State<Number>& state) {
    return loop.is_rough() ? loop.held(state) : std::nullopt;
  }
  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage, const Holding& holding) {
    auto& state = stage.state;
    if (holding.stop != Side::none) state.from_stop = holding.stop, state.offset = 0;
    std::optional<Number> first;
    for (const Side side : {Side::lower, Side::upper})
      if (const auto release = modes::upcoming(modes::in_section(loop, holding.release_phase(loop.constants(), side)),
                                               state.phase_turns, first ? *first : stage.end))
        first = release;
    return laws::hold(stage, holding.stop, first);
  }
};

/// Slips towards a side until it meets the stop ahead, or its velocity falls to 0.
template <class Loop>
class Slip {
 public:
  static constexpr Row row{"slip", "free, its load moved against the velocity", "gap to the stop ahead; velocity",
                           Search::margins, "impact or touch; stick or reversal"};
  static constexpr bool called_for = Stuck<Loop>::called_for;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;
  using Crossing = motion::Crossing<Number>;

  [[nodiscard]] static bool has(const Loop& loop, const State&) { return loop.is_rough(); }

  Slip(Loop& loop, State& state)
      : loop_(loop),
        state_(state),
        ahead_(modes::heading(loop, state)),
        stop_(motion::stop_at<Number>(loop.stops(), ahead_)),
        begins_(state.v == 0),
        rounding_(rounding_of_gap()),
        margins_{modes::gap_ahead(loop, state, ahead_), modes::speed_towards<Number>(ahead_)} {}

  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage) {
    return move(Slip(loop, stage.state), loop, stage);
  }
  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    return function(loop_.slips().towards(ahead_));
  }
  [[nodiscard]] Number release_acceleration() const { return loop_.slips().release_acceleration(ahead_); }
  [[nodiscard]] const auto& margins() const { return margins_; }

  [[nodiscard]] bool is_none(const Crossing& crossing) const { return begins_ && modes::ends_at_once(crossing); }
  template <class Stage>
  [[nodiscard]] Outcome wait(Stage& stage, const Crossing&) const {
    return modes::begin_slip_anew(loop_, stage, ahead_);
  }
  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    const Crossing& crossing = flown.crossing;
    state_.released = false;
    const bool still = modes::is_still(crossing), touches = still && margins_[0].of(crossing.motion) <= rounding_;
    if (still && !touches) modes::turn(loop_, stage, ahead_);
    if (crossing.margin != 0 && !touches) return Outcome::completed;
    state_.x = stop_.position;
    const Number brakes = -stop_.into(crossing.motion.a), speed = stop_.into(state_.v);
    if (touches || speed < 0 || speed * speed <= 2 * brakes * rounding_) state_.v = 0;
    return laws::meet(loop_, stage, stop_);
  }

 private:
  /// Of the gap to a rigid stop at the end of a slip. Without a spring, and with a force that is the same both ways, a
  /// mass that a stop has released comes back to it exactly without speed: it then rests, whatever rounding says. A
  /// flight that a section cuts has its rounding from the beginning.
  [[nodiscard]] Number rounding_of_gap() const {
    using std::abs, std::max;
    const bool begins = begins_ || (state_.from_stop != Side::none && state_.offset == 0);
    const bool may_touch = !is_soft(loop_.stops(), stop_.side) && loop_.finite(stop_.position);
    if (begins || !may_touch) state_.reach = Number(0);
    if (!may_touch) return Number(0);
    const Number way = state_.from_stop == stop_.side ? Number(abs(state_.offset))
                                                      : Number(abs(stop_.position - state_.x) + abs(stop_.position));
    state_.reach = max(state_.reach, way);
    return 64 * epsilon<Number>() * state_.reach;
  }

  Loop& loop_;
  State& state_;
  Side ahead_;
  motion::Stop<Number> stop_;  ///< ahead
  bool begins_;                ///< without speed
  Number rounding_;            ///< of the gap
  std::array<motion::Margin<Number>, 2> margins_;
};

/// Slips in contact with a soft stop until the force of that, or the velocity, falls to 0.
template <class Loop>
class SlipInContact {
 public:
  static constexpr Row row{"slip in contact", "the same, with the soft stop", "force of the stop; velocity",
                           Search::margins, "separation; stick or reversal"};
  static constexpr bool called_for = Slip<Loop>::called_for && Loop::effects.soft;
  using Number = typename Loop::Number;
  using State = motion::State<Number>;
  using Crossing = motion::Crossing<Number>;

  [[nodiscard]] static bool has(const Loop& loop, const State& state) { return loop.is_rough() && state.pressed; }

  SlipInContact(Loop& loop, const State& state)
      : loop_(loop),
        ahead_(modes::heading(loop, state)),
        stop_(motion::soft_stop_at<Number>(loop.stops(), state.within)),
        begins_(state.v == 0) {}

  template <class Stage>
  [[nodiscard]] static Outcome run(Loop& loop, Stage& stage) {
    return move(SlipInContact(loop, stage.state), loop, stage);
  }
  template <class Function>
  decltype(auto) with_oscillator(Function&& function) const {
    return loop_.slips().in_contact(stop_.side, ahead_, function);
  }
  [[nodiscard]] Number release_acceleration() const { return loop_.slips().release_acceleration(ahead_); }
  [[nodiscard]] auto margins() const {
    return std::array{modes::force_of(stop_), modes::speed_towards<Number>(ahead_)};
  }

  [[nodiscard]] bool is_none(const Crossing& crossing) const { return begins_ && modes::ends_at_once(crossing); }
  template <class Stage>
  [[nodiscard]] Outcome wait(Stage& stage, const Crossing&) const {
    return modes::begin_slip_anew(loop_, stage, ahead_);
  }
  template <class Stage, class Flown>
  [[nodiscard]] Outcome end(Stage& stage, const Flown& flown) const {
    stage.state.released = false;
    if (flown.crossing.margin == 0) laws::separate(stage, stop_);
    if (modes::is_still(flown.crossing)) modes::turn(loop_, stage, ahead_);
    return Outcome::completed;
  }

 private:
  Loop& loop_;
  Side ahead_;
  motion::SoftStop<Number> stop_;
  bool begins_;  ///< without speed
};

}  // namespace clatter::stepping
