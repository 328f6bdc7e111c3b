#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "motion/dry_friction.hpp"
#include "motion/housed_arc.hpp"
#include "motion/relative_arc.hpp"
#include "stepping/carrying.hpp"
#include "stepping/modes/hold.hpp"
#include "stepping/modes/row.hpp"
#include "stepping/stage.hpp"

/// Laws of a loose mass on the walls of its housing, and what they ask of the motion.
namespace clatter::stepping {

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
/// Whether a loop has walls, and they may be soft.
template <class Loop>
inline constexpr bool may_meet_soft_walls = Loop::effects.loose && !Loop::carries;
/// Runs a mode of a main mass beside a loose one that is beyond the place of a soft wall.
template <class Mode, class Loop, class Stage>
[[nodiscard]] Outcome fly_at_wall(const Mode& mode, Loop& loop, Stage& stage);
/// The same of a main mass that something holds.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome stay_at_wall(Loop& loop, Stage& stage, Side side,
                                   const std::optional<motion::Holding<Number>>& holding, const Number& until,
                                   bool held);

/// Whether it lies on a wall that presses it, or in a housing in which nothing moves.
template <class Loop, class State>
[[nodiscard]] bool lies_pressed(Loop& loop, const State& state) {
  const auto& loose = state.loose;
  if (!loop.walls().lies_on_wall(loose) || loose.speed != 0 || loose.released) return false;
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
  if (contact.side == Side::none || loop.walls().is_soft(contact.side)) return false;
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
/// Tells of an event of the loose mass on a wall, which changes z' and before which the main mass had the velocity
/// `v`.
template <class Loop, class Stage>
void tell(const Loop& loop, const Stage& stage, typename Stage::Kind kind, Side wall, double before, double after,
          const typename Stage::Number& v) {
  stage.show({.kind = kind,
              .side = wall,
              .time = stage.time(),
              .before = before,
              .after = after,
              .place = static_cast<double>(loop.walls().place(wall)),
              .turns = static_cast<double>(stage.state.phase_turns),
              .main = main_at(stage.state, v)});
}
/// Tells of a contact with the soft wall that a loose mass is on.
template <class Loop, class Stage>
void tell_of_soft_wall(const Loop& loop, const Stage& stage, typename Stage::Kind kind) {
  const double w = static_cast<double>(stage.state.loose.speed);
  tell(loop, stage, kind, stage.state.loose.wall, w, w, stage.state.v);
}
/// A loose mass that meets a wall with z' = w stays on it: both keep their momentum.
template <class Loop, class Stage, class Number>
void press(const Loop& loop, Stage& stage, Side side, const Number& w) {
  auto& state = stage.state;
  const Number before = state.v;
  state.v = loop.walls().rule.main_with(state.v, w);
  state.loose = {side, Number(0), Number(0), true};
  if (modes::rests(loop, state)) state.v = 0, state.loose.may_part = true;
  tell(loop, stage, Stage::Kind::press, side, static_cast<double>(w), 0.0, before);
}
/// Lets a soft wall begin to push, or cease to, once an impact of the main mass has changed z'; false if that is one
/// contact too many.
template <class Loop, class Stage>
[[nodiscard]] bool push_wall_anew(Loop& loop, Stage& stage) {
  motion::LooseState<typename Loop::Number>& loose = stage.state.loose;
  const auto& wall = loop.walls().soft[index_of(loose.wall)];
  const bool pushes = wall.force(wall.into(loose.place), wall.into(loose.speed)) > 0;
  if (std::exchange(loose.pushed, pushes) == pushes) return true;
  tell_of_soft_wall(loop, stage, pushes ? Stage::Kind::wall_renewal : Stage::Kind::wall_separation);
  return !pushes || loop.count_impact();
}
/// An impact on a wall with z' = w (eq. 70), after which that may press the loose mass; or the touch of a soft one.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome strike(Loop& loop, Stage& stage, Side side, const Number& w) {
  auto& state = stage.state;
  if (!(sign_of(side) * w > 0)) {  // it touches
    if (loop.walls().is_rough()) state.loose.speed = 0;
    return Outcome::completed;
  }
  if (loop.walls().is_soft(side)) {
    state.released = false;
    state.loose = {.wall = side, .speed = w, .within = true, .pushed = true};
    tell_of_soft_wall(loop, stage, Stage::Kind::wall_touch);
    return loop.count_impact() ? Outcome::completed : Outcome::event_budget;
  }
  const auto& rule = loop.walls().rule;
  const Number before = state.v, after = rule.law(side).after(w);
  state.v = rule.main_after(state.v, w), state.released = false;
  state.loose = {side, Number(0), after};
  tell(loop, stage, Stage::Kind::strike, side, static_cast<double>(w), static_cast<double>(after), before);
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
  if (loop.walls().lies_on_wall(loose)) return press(loop, stage, loose.wall, Number(0));
  const bool in_wall = loose.within && loose.place != 0;
  loose = {.wall = loose.wall, .place = loose.place, .pressed = true, .within = in_wall, .pushed = in_wall};
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

}  // namespace clatter::stepping
