#pragma once

#include <cmath>
#include <optional>

#include "motion/housed_arc.hpp"
#include "motion/relative_arc.hpp"
#include "stepping/modes/hold.hpp"
#include "stepping/modes/row.hpp"
#include "stepping/modes/strike.hpp"

/// What a loose mass adds to every mode of the main one: a parabola beside its flight, or a share in its mass, and one
/// more guard.
namespace clatter::stepping {

/// The loose mass flies between the walls of its housing.
inline constexpr Row flying_row{"flying", "its parabola, beside the mode's", "gaps to both walls", Search::gaps,
                                "impact of the loose mass, press"};
/// The loose mass slides on its housing.
inline constexpr Row sliding_row{"sliding", "its parabola, beside the mode's, both with its friction",
                                 "gaps to both walls; its velocity in the housing", Search::gaps,
                                 "impact of the loose mass, press; stick in the housing, reversal"};
/// A wall presses the loose mass: both move as one until the wall would have to pull.
inline constexpr Row pressed_row{"pressed", "the mode's, of both masses as one",
                                 "force of the wall, in the acceleration", Search::pull, "release"};
/// Friction holds the loose mass in its housing: both move as one until the force on it passes the static level.
inline constexpr Row stuck_row{"stuck", "the mode's, of both masses as one",
                               "the level of friction to both sides, in the acceleration", Search::pull, "release"};

namespace modes {

/// The end of a flight of a loose mass, in which it may also come to a stop by friction.
template <class Number>
struct LooseEnd {
  motion::Crossing<Number> contact;  ///< with a wall, or the end by another event
  bool stops = false;                ///< friction has stopped it
  bool is_none = false;              ///< rounding alone tells the flight from none
};
template <class Loop, class State, class Beside, class Number>
[[nodiscard]] LooseEnd<Number> end_of_loose(Loop& loop, const State& state, const Beside& beside,
                                            const Number& horizon) {
  const auto& walls = loop.walls();
  LooseEnd<Number> end{loop.method().meet_wall(beside, walls.places, horizon)};
  motion::Crossing<Number>& contact = end.contact;
  const Number w = state.loose.wall == Side::none ? Number(state.loose.speed - state.v) : state.loose.speed;
  end.is_none = is_lost(loop, state, contact, w);
  if (!walls.is_rough() || !contact.resolved || end.is_none || contact.elapsed == 0) return end;
  const motion::Crossing<Number> still = loop.method().come_to_stop(beside, walls.slides_to, contact.elapsed);
  const bool is_first = still.margin == 0 && (contact.side == Side::none || still.elapsed < contact.elapsed);
  if (still.resolved && !is_first) return end;
  contact = still, contact.motion.v = 0;
  end.stops = true, end.is_none = still.resolved && w == 0 && still.elapsed <= loop.shortest_hop();
  return end;
}
/// Ends a flight that is none: the loose mass stays where it is.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome wait_in_housing(Loop& loop, Stage& stage, const LooseEnd<Number>& end, const Number& w) {
  if (!end.stops) return laws::wait_on_wall(loop, stage, end.contact.side, w);
  laws::stop(loop, stage);
  return laws::keep(loop, stage);
}

/// Ends a flight of the main mass beside which the loose one flies: with an event of its own, or where that strikes, or
/// comes to a stop.
template <class Mode, class Loop, class Stage, class A, class Flown>
[[nodiscard]] Outcome end_flying(const Mode& mode, Loop& loop, Stage& stage, const A& main, Flown flown) {
  using Number = typename Loop::Number;
  using std::abs;
  auto& state = stage.state;
  const auto& walls = loop.walls();
  const auto start = loose_start_of(loop, state);
  const auto beside = loop.method().beside(main, start, walls.load);
  const LooseEnd<Number> end = end_of_loose(loop, state, beside, flown.crossing.elapsed);
  const motion::Crossing<Number>& contact = end.contact;
  if (!contact.resolved) return loop.outcome_at(contact);
  if (end.is_none) return wait_in_housing(loop, stage, end, start.w);
  const bool meets = contact.side != Side::none, together = contact.elapsed == flown.crossing.elapsed;
  const bool is_slower = abs(contact.motion.v) < abs(flown.crossing.motion.v);
  const bool strikes = meets && !(flown.is_event() && together && is_slower);
  const bool stops = end.stops && !(flown.is_event() && together);
  if (strikes || stops || !Loop::effects.stops()) {
    if (!(flown.is_event() && together)) flown.crossing.motion = main.at(contact.elapsed);
    flown.crossing.margin = flown.guards, flown.crossing.side = Side::none, flown.crossing.elapsed = contact.elapsed;
  }
  stage.show(motion::HousedArc{main, beside}, contact.elapsed);
  move_loose(walls, state.loose, contact);
  const Outcome outcome = end_main(mode, stage, flown);
  if (outcome != Outcome::completed || !strikes) return outcome;
  const Outcome struck = laws::strike(loop, stage, contact.side, contact.motion.v);
  return struck == Outcome::completed ? push_anew(loop, stage) : struck;
}
/// Ends a flight of both masses as one: with an event of the main mass, or where the wall would have to pull, or the
/// friction to hold more than it can.
template <class Mode, class Loop, class Stage, class A, class Flown>
[[nodiscard]] Outcome end_pressed(const Mode& mode, Loop& loop, Stage& stage, const A& main, Flown flown) {
  using Number = typename Loop::Number;
  auto& state = stage.state;
  auto& loose = state.loose;
  if (parts(state, hold_at(loop.walls(), loose, flown.start.a).left)) return Outcome::completed;
  bool releases = false;
  if (!stage.keeps_pressed) {
    const motion::Crossing<Number> pull = end_of_hold(loop, state, main, flown.crossing.elapsed);
    if (!pull.resolved) return loop.outcome_at(pull);
    releases = pull.margin == 0 && !(flown.is_event() && pull.elapsed == flown.crossing.elapsed);
    if (releases || !Loop::effects.stops()) flown.crossing = {flown.guards, Side::none, pull.elapsed, pull.motion};
  } else if (!Loop::effects.stops()) {
    flown.crossing.motion = main.at(flown.crossing.elapsed);
  }
  show_as_one(loop, stage, main, flown.crossing.elapsed);
  const bool is_event = flown.is_event();
  const Outcome outcome = end_main(mode, stage, flown);
  if (releases)
    loose.pressed = false, loose.released = true;
  else if (loose.pressed)
    loose.may_part = is_event;
  return outcome;
}
/// Holds the main mass up to the phase `until`, or until the loose one strikes.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome stay_in_housing(Loop& loop, Stage& stage, Side side, const Number& until, bool held) {
  auto& state = stage.state;
  const auto& walls = loop.walls();
  const auto& constants = loop.held_constants(Loop::carries);
  const Number length = (until - state.phase_turns) * loop.period();
  const auto main = loop.method().held_arc(constants, state, loop.motion(constants, state), loop.anchor(state), length);
  if constexpr (Loop::carries) {
    if (hold_at(walls, state.loose, Number(0)).left < 0 && parts(state, Number(0))) return Outcome::completed;
    stage.show_rest(side, Number(until - state.phase_turns), held, static_cast<double>(constants.carried));
    show_as_one(loop, stage, main, length);
    state.phase_turns = until;
    return Outcome::completed;
  } else {
    if constexpr (may_meet_soft_walls<Loop>)
      if (state.loose.within) return stay_at_wall<Loop, Stage, Number>(loop, stage, side, std::nullopt, until, held);
    const auto start = loose_start_of(loop, state);
    const auto beside = loop.method().beside(main, start, walls.load);
    const LooseEnd<Number> end = end_of_loose(loop, state, beside, length);
    const motion::Crossing<Number>& contact = end.contact;
    if (!contact.resolved) return loop.outcome_at(contact);
    if (end.is_none) return wait_in_housing(loop, stage, end, start.w);
    stage.show_rest(side, Number(contact.elapsed / loop.period()), held, 0.0,
                    static_cast<double>(loop.constants().rubbing));
    stage.show(motion::HousedArc{main, beside}, contact.elapsed);
    move_loose(walls, state.loose, contact);
    if (contact.elapsed == length)
      state.phase_turns = until;
    else
      stage.pass(contact.elapsed);
    if (contact.side == Side::none) return Outcome::completed;
    const Outcome struck = laws::strike(loop, stage, contact.side, contact.motion.v);
    return struck == Outcome::completed ? push_anew(loop, stage) : struck;
  }
}

}  // namespace modes

}  // namespace clatter::stepping
