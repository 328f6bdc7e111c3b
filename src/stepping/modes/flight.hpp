#pragma once

#include <cstddef>

#include "stepping/integrator.hpp"
#include "stepping/stage.hpp"

namespace clatter::stepping {

/// An arc and its end: the first of its margins that falls to 0, else the horizon, or an earlier instant if the method
/// divides the flight into several arcs.
template <class A>
struct ArcToEvent {
  A arc;
  motion::Crossing<typename A::Number> crossing{};
};

namespace modes {

/// The beginning of a flight, whose acceleration at a release is known exactly.
template <class Mode, class Loop, class Constants, class State>
[[nodiscard]] auto start_of(const Mode& mode, const Loop& loop, const Constants& constants, const State& state) {
  using Number = typename Loop::Number;
  Number released(0);
  if constexpr (requires { mode.release_acceleration(); }) {
    released = mode.release_acceleration();
    if constexpr (Loop::effects.loose && !Loop::carries) {
      const bool moved_with = state.loose.place == 0 || loop.walls().is_rough();
      if (state.loose.wall != Side::none && moved_with && state.loose.speed == 0)
        released -= loop.walls().rule.ratio * loop.walls().load;  // both were let go, and the loose one falls behind
    }
  }
  auto start = loop.motion(constants, state, released);
  if constexpr (Loop::effects.loose && !Loop::carries)
    if (state.loose.released) start.a = loop.walls().load + loop.walls().jump;  // without friction z'' = 0 there
  return start;
}

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
  motion::Crossing<Number> crossing;
  Number horizon;
  std::size_t guards;  ///< of the mode

  /// Whether it ends with the first of them, not at the horizon.
  [[nodiscard]] bool is_event() const { return crossing.side != Side::none || crossing.margin < guards; }
};

/// Ends a flight of the main mass.
template <class Mode, class Stage, class Flown>
[[nodiscard]] Outcome end_main(const Mode& mode, Stage& stage, const Flown& flown) {
  auto& state = stage.state;
  const auto& crossing = flown.crossing;
  stage.pass(crossing.elapsed);
  state.x = crossing.motion.x, state.v = crossing.motion.v, state.offset = crossing.motion.offset;
  return mode.end(stage, flown);
}

}  // namespace clatter::stepping
