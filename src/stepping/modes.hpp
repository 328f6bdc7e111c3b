#pragma once

#include <tuple>
#include <type_traits>
#include <utility>

#include "stepping/modes/between.hpp"
#include "stepping/modes/friction.hpp"
#include "stepping/modes/housing.hpp"
#include "stepping/modes/rest.hpp"
#include "stepping/modes/soft_stops.hpp"

namespace clatter::stepping {

/// THE table of modes, each with its row: the oscillator that the mass belongs to, the guards whose first fall to 0
/// ends it, the rule by which that is searched, and the laws of the events there. A state is in the first that has it.
template <template <class...> class List, class Loop>
using Table = List<Pressed<Loop>, InHousing<Loop>, InChatter<Loop>, Beyond<Loop>, Stuck<Loop>, SlipInContact<Loop>,
                   Slip<Loop>, InContact<Loop>, AtRest<Loop>, Between<Loop>>;

/// The modes that the effects of a loop call for.
template <class... Modes>
using CalledFor = decltype(std::tuple_cat(
    std::declval<std::conditional_t<Modes::called_for, std::tuple<std::type_identity<Modes>>, std::tuple<>>>()...));
template <class Loop>
using Modes = Table<CalledFor, Loop>;

namespace modes {

/// Completes a state that a start, or another mode, leaves: a mass beyond a soft stop's position is known as such.
template <class Loop, class State>
void enter(const Loop& loop, State& state) {
  constexpr Effects E = Loop::effects;
  if (E.loose || state.chatters) return;
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
