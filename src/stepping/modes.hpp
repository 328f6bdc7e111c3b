#pragma once

#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "stepping/modes/between.hpp"
#include "stepping/modes/friction.hpp"
#include "stepping/modes/rest.hpp"
#include "stepping/modes/soft_stops.hpp"

namespace clatter::stepping {

/// THE table of modes, each with its row: the oscillator that the mass belongs to, the guards whose first fall to 0
/// ends it, the rule by which that is searched, and the laws of the events there. A state is in the first that has it.
/// A loose mass adds a guard to each (`modes/housing.hpp`).
template <template <class...> class List, class Loop>
using Table = List<InChatter<Loop>, Beyond<Loop>, Stuck<Loop>, SlipInContact<Loop>, Slip<Loop>, InContact<Loop>,
                   AtRest<Loop>, Between<Loop>>;

/// The modes that the effects of a loop call for.
template <class... Modes>
using CalledFor = decltype(std::tuple_cat(
    std::declval<std::conditional_t<Modes::called_for, std::tuple<std::type_identity<Modes>>, std::tuple<>>>()...));
template <class Loop>
using Modes = Table<CalledFor, Loop>;

namespace modes {

/// Whether the main mass stays where it is in a mode.
template <class Mode>
inline constexpr bool holds = Mode::row.search == Search::closed_form;

template <class Loop, class Stage, class Mode, class... Others>
[[nodiscard]] Outcome run_first_of(Loop& loop, Stage& stage, std::tuple<std::type_identity<Mode>, Others...>) {
  if (const auto has = Mode::has(loop, stage.state)) {
    if constexpr (requires { Mode::run(loop, stage); })
      return Mode::run(loop, stage);
    else if constexpr (requires { Mode::run(loop, stage, *has); })
      return Mode::run(loop, stage, *has);
    else
      return run(Mode{loop, stage.state}, loop, stage);
  }
  if constexpr (sizeof...(Others) > 0) return run_first_of(loop, stage, std::tuple<Others...>());
  return Outcome::completed;  // the last has any state
}
template <class Loop, class Stage>
Outcome run_first(Loop& loop, Stage& stage) {
  return run_first_of(loop, stage, Modes<Loop>());
}

template <class Loop, class State, class Mode, class... Others>
[[nodiscard]] std::optional<typename Loop::Number> acceleration_in(Loop& loop, State& state,
                                                                   std::tuple<std::type_identity<Mode>, Others...>) {
  using Number = typename Loop::Number;
  if (!Mode::has(loop, state)) {
    if constexpr (sizeof...(Others) > 0) return acceleration_in(loop, state, std::tuple<Others...>());
  } else if constexpr (!holds<Mode>) {
    const Mode mode{loop, state};
    return mode.with_oscillator(
        [&](const auto& constants) -> Number { return start_of(mode, loop, constants, state).a; });
  }
  return std::nullopt;
}
template <class Loop, class State>
std::optional<typename Loop::Number> acceleration(Loop& loop, const State& state) {
  State copy = state;
  return acceleration_in(loop, copy, Modes<Loop>());
}

template <class Loop, class Stage>
Outcome push_anew(Loop& loop, Stage& stage) {
  if constexpr (Loop::effects.soft) {
    auto& state = stage.state;
    if (state.within == Side::none) return Outcome::completed;
    const auto stop = motion::soft_stop_at<typename Loop::Number>(loop.stops(), state.within);
    const bool pushes = stop.force(stop.into(state.offset), stop.into(state.v)) > 0;
    if (pushes && !state.pressed) return laws::renew(loop, stage, stop.side);
    if (!pushes && state.pressed) laws::separate(stage, stop);
  }
  return Outcome::completed;
}

/// Completes a state that a start, or another mode, leaves: a mass beyond a soft stop's position is known as such.
template <class Loop, class State>
void enter(const Loop& loop, State& state) {
  constexpr Effects E = Loop::effects;
  if (state.chatters) return;
  if constexpr (E.friction)
    if (loop.is_rough()) end_creep(loop, state);
  if constexpr (E.soft) {
    if (!loop.has_soft_stops()) return;
    if (state.within == Side::none) {
      const auto around = motion::soft_stop_around(loop.stops(), state.x, state.v);
      if (around.side == Side::none) return;
      state.within = state.from_stop = around.side, state.offset = around.offset, state.pressed = around.pressed;
    }
    if (loop.is_rough() && state.v == 0) state.pressed = true;  // the stop has come up to the mass
  }
}
/// Keeps a flight that is cut just where it comes to a soft stop between the stops: rounding may put it beyond, and the
/// touch would be passed.
template <class Loop, class State>
void keep_before_touch(const Loop& loop, State& state) {
  if (!loop.has_soft_stops() || state.within != Side::none) return;
  const auto& stops = loop.stops();
  if (is_soft(stops, Side::lower) && state.x < stops.lower) state.x = stops.lower;
  if (is_soft(stops, Side::upper) && state.x > stops.upper) state.x = stops.upper;
}

}  // namespace modes

}  // namespace clatter::stepping
