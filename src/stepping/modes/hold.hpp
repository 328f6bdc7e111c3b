#pragma once

#include <optional>
#include <utility>

#include "motion/housed_arc.hpp"
#include "stepping/carrying.hpp"
#include "stepping/stage.hpp"

/// What makes a loose mass move with the main one: the force of a wall, friction on the housing, or both.
namespace clatter::stepping {
namespace modes {

/// The acceleration of the main mass in that mode; nothing if something holds it.
template <class Loop, class State>
[[nodiscard]] std::optional<typename Loop::Number> acceleration(Loop& loop, const State& state);
/// Calls `function(pressing)` with all that makes a loose mass move with the main one: the wall that it is on with the
/// friction, away from which that holds it to either side.
template <class Number, class Function>
void for_each_hold(const motion::Walls<Number>& walls, const motion::LooseState<Number>& loose, Function&& function) {
  const bool on_wall = walls.lies_on_wall(loose);
  const Number load = walls.load - walls.push(loose) / walls.rule.ratio;
  for (const Side side : {Side::lower, Side::upper})
    if (on_wall ? side == loose.wall : walls.is_rough())
      function(Pressing<Number>{side, Number(load + sign_of(side) * walls.hold)});
}
/// How much force is left, as an acceleration of the loose mass, until it leaves a main mass of some acceleration, and
/// the side of that force.
template <class Number>
struct Hold {
  Side side = Side::none;
  Number left{};
};
template <class Number>
[[nodiscard]] Hold<Number> hold_at(const motion::Walls<Number>& walls, const motion::LooseState<Number>& loose,
                                   const Number& a) {
  Hold<Number> least;
  for_each_hold(walls, loose, [&](const Pressing<Number>& pressing) {
    const Number left = sign_of(pressing.wall) * (pressing.load - a);
    if (least.side == Side::none || left < least.left) least = {pressing.wall, left};
  });
  return least;
}
/// The side to which a loose mass slides in its housing; none: friction holds it there, or a wall and friction.
template <class Loop, class State>
[[nodiscard]] Side slides_to(Loop& loop, const State& state) {
  using Number = typename Loop::Number;
  const auto& loose = state.loose;
  if (loose.speed != 0) return loose.speed > 0 ? Side::upper : Side::lower;
  return loop.as_one([&](auto& both) {
    const auto a = acceleration(both, state);
    const Hold<Number> hold = hold_at(both.walls(), loose, a.value_or(Number(0)));
    const bool holds = hold.left > 0 || (hold.left == 0 && !a);
    return holds && !loose.released ? Side::none : opposite(hold.side);
  });
}
/// The first instant at which what makes a loose mass move with the main one lets it go, or the horizon.
template <class Loop, class State, class A, class Number>
[[nodiscard]] motion::Crossing<Number> end_of_hold(Loop& loop, const State& state, const A& main,
                                                   const Number& horizon) {
  std::optional<motion::Crossing<Number>> first;
  for_each_hold(loop.walls(), state.loose, [&](const Pressing<Number>& pressing) {
    if (first && (!first->resolved || (first->margin == 0 && first->elapsed == 0))) return;
    const motion::Crossing<Number> end = loop.method().let_go(main, pressing, first ? first->elapsed : horizon);
    if (!first || !end.resolved || end.margin == 0) first = end;
  });
  return *first;
}
/// Shows the motion of both masses as one, by a wall or by friction alone.
template <class Loop, class Stage, class A, class Number>
void show_as_one(const Loop& loop, const Stage& stage, const A& main, const Number& length) {
  const auto& loose = stage.state.loose;
  const Side side = loop.walls().lies_on_wall(loose) ? loose.wall : Side::none;
  const double place = static_cast<double>(loop.walls().place(loose.wall) + loose.place);
  stage.show(motion::HousedArc{main, motion::Pressed{side, place}}, length);
  stage.show({.kind = Stage::Kind::hold,
              .side = side,
              .time = stage.time(),
              .length = static_cast<double>(length),
              .place = place,
              .has_arc = true});
}
/// Whether what held a loose mass up to an event of the main one no longer does so.
template <class State, class Number>
[[nodiscard]] bool parts(State& state, const Number& into) {
  if (!std::exchange(state.loose.may_part, false) || into > 0) return false;
  state.loose.pressed = false;
  return true;
}

}  // namespace modes
}  // namespace clatter::stepping
