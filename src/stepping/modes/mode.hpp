#pragma once

#include <cstddef>
#include <type_traits>

#include "stepping/modes/flight.hpp"
#include "stepping/modes/housing.hpp"
#include "stepping/modes/row.hpp"
#include "stepping/modes/soft_wall.hpp"

namespace clatter::stepping {

/// Runs a mode in which the mass moves: on one arc of the mode's oscillator, up to the first of its guards or to the
/// end of the stage. A flight that ends where it begins, or that rounding alone tells from none, is none.
template <class Mode, class Loop, class Stage>
[[nodiscard]] Outcome run(const Mode& mode, Loop& loop, Stage& stage) {
  using Number = typename Loop::Number;
  constexpr bool by_gaps = Mode::row.search == Search::gaps;
  motion::State<Number>& state = stage.state;
  if constexpr (modes::may_meet_soft_walls<Loop>)
    if (state.loose.within) return modes::fly_at_wall(mode, loop, stage);
  return mode.with_oscillator([&](const auto& constants) {
    const Number horizon = stage.time_left(), anchor = loop.anchor(state);
    const motion::Motion<Number> start = modes::start_of(mode, loop, constants, state);
    const auto flight = [&] {
      if constexpr (by_gaps)
        return loop.method().fly(constants, state, start, anchor, horizon);
      else
        return loop.method().fly_within(constants, state, start, anchor, mode.margins(), horizon);
    }();
    const motion::Crossing<Number>& crossing = flight.crossing;
    if (!crossing.resolved) return loop.outcome_at(crossing);
    if constexpr (requires { mode.is_none(crossing); })
      if (mode.is_none(crossing)) return mode.wait(stage, crossing);
    std::size_t guards = 0;
    if constexpr (!by_gaps) guards = mode.margins().size();
    const Flown<Number, std::remove_cvref_t<decltype(constants)>> flown{constants, start, crossing, horizon, guards};
    if constexpr (Loop::effects.loose && Loop::carries) {
      return modes::end_pressed(mode, loop, stage, flight.arc, flown);
    } else if constexpr (Loop::effects.loose) {
      return modes::end_flying(mode, loop, stage, flight.arc, flown);
    } else {
      stage.show(flight.arc, crossing.elapsed);
      return end_main(mode, stage, flown);
    }
  });
}

}  // namespace clatter::stepping
