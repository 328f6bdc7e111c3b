#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "motion/housed_arc.hpp"
#include "motion/relative_arc.hpp"
#include "stepping/carrying.hpp"
#include "stepping/modes/hold.hpp"
#include "stepping/modes/row.hpp"
#include "stepping/stage.hpp"

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

/// Runs the first mode of the table that has the state.
template <class Loop, class Stage>
[[nodiscard]] Outcome run_first(Loop& loop, Stage& stage);
/// Lets a soft stop beyond whose position the mass is begin to push, or cease to, once an impact has changed its speed.
template <class Loop, class Stage>
[[nodiscard]] Outcome push_anew(Loop& loop, Stage& stage);

/// The acceleration z'' with which a loose mass that rebounds from a wall is driven back into it.
template <class Loop, class State>
[[nodiscard]] auto into_wall(Loop& loop, Side side, const State& state) {
  using Number = typename Loop::Number;
  return loop.beside(opposite(side), [&](auto& leaving) {
    return Number(sign_of(side) * (leaving.walls().load - acceleration(leaving, state).value_or(Number(0))));
  });
}
/// Whether it lies on a wall that presses it, or in a housing in which nothing moves.
template <class Loop, class State>
[[nodiscard]] bool lies_pressed(Loop& loop, const State& state) {
  const auto& loose = state.loose;
  if (loose.wall == Side::none || loose.place != 0 || loose.speed != 0 || loose.released) return false;
  const auto into = into_wall(loop, loose.wall, state);
  return into > 0 || (into == 0 && !acceleration(loop, state));
}
/// The share of a motion below which a rebound is lost in its rounding. In 50 digits, the reference for double, it
/// lies far below all that a double can tell, and above rounding, since each impact there takes up to a millisecond.
template <class Number>
[[nodiscard]] Number faded() {
  if constexpr (std::numeric_limits<Number>::digits10 <= std::numeric_limits<double>::digits10)
    return epsilon<Number>();
  return Number(1e-30);
}
/// The speed of the main mass, or what its displacement stands for.
template <class Loop, class State>
[[nodiscard]] auto extent(const Loop& loop, const State& state) {
  using std::abs;
  const auto& c = loop.constants();
  return typename Loop::Number(abs(state.v) + c.natural * abs(state.x - c.equilibrium));
}
/// Whether nothing can tell the rest of a chatter: a rebound with the speed w changes no digit of the motion, or
/// doesn't let time go on.
template <class Loop, class State, class Number>
[[nodiscard]] bool is_faded(const Loop& loop, const State& state, const Number& w, const Number& pressing) {
  if (!(pressing > 0)) return false;
  if (w == 0) return true;
  if (!loop.loses()) return false;
  return w <= faded<Number>() * extent(loop, state) || 2 * w <= pressing * epsilon<Number>() * loop.period();
}
/// The speed below which an impact of a mass at x is lost in the rounding of its motion.
template <class Loop, class Number>
[[nodiscard]] Number faded_speed(const Loop& loop, const Number& x) {
  using std::abs;
  const auto& c = loop.constants();
  return faded<Number>() * (c.rate * abs(x) + (abs(c.f) + abs(c.load)) / c.rate);
}
/// Whether a main mass is on a rigid stop, and leaves it, or meets it, more slowly than rounding tells: then it rests
/// there, with the loose one if that strikes as slowly.
template <class Loop, class State>
[[nodiscard]] bool rests(const Loop& loop, const State& state) {
  using std::abs;
  if constexpr (!Loop::effects.rest) return false;
  if (state.from_stop == Side::none || state.offset != 0 || state.within != Side::none || !loop.loses()) return false;
  return abs(state.v) <= faded_speed(loop, state.x);
}
/// Whether a flight that begins with z' = w ends where nothing tells it from a press: at once, or on the wall that it
/// begins on, from which it rises by less than rounding. The force of the wall touches zero there, and its sign is
/// that of rounding.
template <class Loop, class State, class Number>
[[nodiscard]] bool is_lost(const Loop& loop, const State& state, const motion::Crossing<Number>& contact,
                           const Number& w) {
  using std::abs;
  if (contact.side == Side::none) return false;
  if (contact.elapsed == 0 && w == 0) return true;
  const motion::LooseState<Number>& loose = state.loose;
  if (loose.wall != contact.side || loose.place != 0 || !(contact.elapsed <= loop.shortest_hop())) return false;
  return abs(w) <= faded<Number>() * extent(loop, state);
}
template <class Loop, class State>
[[nodiscard]] motion::RelativeStart<typename Loop::Number> loose_start_of(const Loop& loop, const State& state) {
  using Number = typename Loop::Number;
  const motion::LooseState<Number>& loose = state.loose;
  if (loose.wall == Side::none) return {Number(0), loose.place - state.x, loose.speed - state.v, loose.speed};
  return {loop.walls().place(loose.wall), loose.place, loose.speed, loose.speed + state.v};
}
/// Moves a loose mass to the end of a flight, or to its contact.
template <class Walls, class Number>
void move_loose(const Walls& walls, motion::LooseState<Number>& loose, const motion::Crossing<Number>& contact) {
  if (contact.side != Side::none) {
    loose = {contact.side, Number(0), contact.motion.v};
  } else if (loose.wall != Side::none) {
    loose = {loose.wall, contact.motion.offset, contact.motion.v};
  } else {
    loose.place += (loose.speed + walls.load * contact.elapsed / 2) * contact.elapsed;
    loose.speed += walls.load * contact.elapsed;
  }
}
}  // namespace modes

namespace laws {

/// The main mass at an event, before which it had the velocity `before`.
template <class Number>
[[nodiscard]] motion::Event::Main main_at(const motion::State<Number>& state, const Number& before) {
  return {static_cast<double>(state.x), static_cast<double>(before), static_cast<double>(state.v)};
}
/// A loose mass that meets a wall with z' = w stays on it: both keep their momentum.
template <class Loop, class Stage, class Number>
void press(const Loop& loop, Stage& stage, Side side, const Number& w) {
  auto& state = stage.state;
  const Number before = state.v;
  state.v = loop.walls().rule.main_with(state.v, w);
  state.loose = {side, Number(0), Number(0), true};
  if (modes::rests(loop, state)) state.v = 0, state.loose.may_part = true;
  stage.show({.kind = Stage::Kind::press,
              .side = side,
              .time = stage.time(),
              .before = static_cast<double>(w),
              .place = static_cast<double>(loop.walls().place(side)),
              .main = main_at(state, before)});
}
/// An impact on a wall with z' = w (eq. 70), after which that may press the loose mass.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome strike(Loop& loop, Stage& stage, Side side, const Number& w) {
  auto& state = stage.state;
  if (!(sign_of(side) * w > 0)) {  // it touches
    if (loop.walls().is_rough()) state.loose.speed = 0;
    return Outcome::completed;
  }
  const auto& rule = loop.walls().rule;
  const Number before = state.v, after = rule.law(side).after(w);
  state.v = rule.main_after(state.v, w), state.released = false;
  state.loose = {side, Number(0), after};
  stage.show({.kind = Stage::Kind::strike,
              .side = side,
              .time = stage.time(),
              .before = static_cast<double>(w),
              .after = static_cast<double>(after),
              .place = static_cast<double>(loop.walls().place(side)),
              .turns = static_cast<double>(state.phase_turns),
              .main = main_at(state, before)});
  const Number rebound = -sign_of(side) * after;
  const bool collapses = modes::rests(loop, state) && rebound <= modes::faded_speed(loop, state.x);
  if (collapses || modes::is_faded(loop, state, rebound, modes::into_wall(loop, side, state)))
    press(loop, stage, side, after);
  return loop.count_impact() ? Outcome::completed : Outcome::event_budget;
}
/// A loose mass that has come to a stop in its housing moves with the main one.
template <class Loop, class Stage>
void stop(const Loop& loop, Stage& stage) {
  using Number = typename Loop::Number;
  motion::LooseState<Number>& loose = stage.state.loose;
  if (loose.place == 0) return press(loop, stage, loose.wall, Number(0));
  loose = {loose.wall, loose.place, Number(0), true};
}
/// Holds the loose mass past an instant at which the force that lets it go is zero to rounding, so its sign decides
/// nothing. After sqrt(epsilon) of a period it is clear of rounding.
template <class Loop, class Stage>
[[nodiscard]] Outcome keep(Loop& loop, Stage& stage) {
  using std::min, std::sqrt;
  using Number = typename Loop::Number;
  const Number end = min(stage.end, Number(stage.state.phase_turns + sqrt(epsilon<Number>())));
  stage.state.loose.may_part = false;
  Stage shorter = stage.up_to(end);
  shorter.keeps_pressed = true;
  const Outcome outcome = loop.run_carrying(shorter);
  stage.state.loose.pressed = false;
  return outcome;
}
/// The same on a wall, which it meets with z' = w.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome wait_on_wall(Loop& loop, Stage& stage, Side side, const Number& w) {
  press(loop, stage, side, w);
  return keep(loop, stage);
}

}  // namespace laws

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
