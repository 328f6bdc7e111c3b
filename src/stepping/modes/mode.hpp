#pragma once

#include <string_view>
#include <type_traits>

#include "stepping/integrator.hpp"
#include "stepping/stage.hpp"

namespace clatter::stepping {

/// How the first of a mode's guards that falls to 0 is found: gaps to rigid stops and walls keep their relative
/// accuracy by a rule of their own (`motion::GapRule`), as does the pull of a wall (`PullRule`); all else goes by
/// `MarginRule`, or is known in closed form.
enum class Search { gaps, margins, pull, closed_form };

/// A mode in words: a row of the guide's table.
struct Row {
  std::string_view mode, oscillator, guards;
  Search search;
  std::string_view laws;
};

/// An arc and its end: the first of its margins that falls to 0, else the horizon, or an earlier instant if the method
/// divides the flight into several arcs. Of a loose mass the arc is that in its housing, and knows that of the main
/// mass.
template <class A>
struct ArcToEvent {
  A arc;
  motion::Crossing<typename A::Number> crossing{};
};

namespace modes {

/// The force of a soft stop, over its stiffness, as a margin of a mass in contact.
template <class Number>
[[nodiscard]] motion::Margin<Number> force_of(const motion::SoftStop<Number>& stop) {
  return {Number(0), stop.into(Number(1)), stop.into(stop.relaxation())};
}

}  // namespace modes

/// A flight up to its end.
template <class Number, class Constants>
struct Flown {
  const Constants& constants;
  const motion::Motion<Number>& start;
  const motion::Crossing<Number>& crossing;
  Number horizon;
};

/// Runs a mode in which the mass moves: on one arc of the mode's oscillator, up to the first of its guards or to the
/// end of the stage. A flight that ends where it begins, or that rounding alone tells from none, is none.
template <class Mode, class Loop, class Stage>
[[nodiscard]] Outcome run(const Mode& mode, Loop& loop, Stage& stage) {
  using Number = typename Loop::Number;
  motion::State<Number>& state = stage.state;
  return mode.with_oscillator([&](const auto& constants) {
    const Number horizon = stage.time_left(), anchor = loop.anchor(state);
    const motion::Motion<Number> start = [&] {
      if constexpr (requires { mode.release_acceleration(); })
        return loop.motion(constants, state, mode.release_acceleration());
      else
        return loop.motion(constants, state);
    }();
    const auto flight = [&] {
      if constexpr (Mode::row.search == Search::gaps)
        return loop.method().fly(state, start, anchor, horizon);
      else
        return loop.method().fly_within(constants, state, start, anchor, mode.margins(), horizon);
    }();
    const motion::Crossing<Number>& crossing = flight.crossing;
    if (!crossing.resolved) return loop.outcome_at(crossing);
    if constexpr (requires { mode.is_none(crossing); })
      if (mode.is_none(crossing)) return mode.wait(stage, crossing);
    stage.show(flight.arc, crossing.elapsed);
    stage.pass(crossing.elapsed);
    state.x = crossing.motion.x, state.v = crossing.motion.v, state.offset = crossing.motion.offset;
    return mode.end(stage,
                    Flown<Number, std::remove_cvref_t<decltype(constants)>>{constants, start, crossing, horizon});
  });
}

}  // namespace clatter::stepping
