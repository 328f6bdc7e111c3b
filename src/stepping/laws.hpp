#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "motion/contact_force.hpp"
#include "motion/soft_stop.hpp"
#include "stepping/integrator.hpp"
#include "stepping/modes/housing.hpp"
#include "stepping/stage.hpp"

namespace clatter::stepping {

/// Laws of the events of a mass between stops: each gives the state after, whose numbers say which mode is next, and
/// tells of the event.
namespace laws {

/// Reverses the velocity at a rigid stop (eq. 4).
template <class Number>
void reverse(motion::State<Number>& state, const motion::Stop<Number>& stop) {
  state.from_stop = stop.side, state.offset = 0;
  if (stop.into(state.v) > 0) state.v = stop.law.after(state.v);
  if (state.v == 0) state.v = 0;  // no negative zero
}
/// Ends a summed chatter in rest.
template <class Loop, class Number>
void complete_chatter(const Loop& loop, motion::State<Number>& state, const Number& left) {
  state.phase_turns += left / loop.period();
  state.v = 0, state.chatters = false;
}
/// Whether nothing can tell the rest of a chatter on a stop from a rest. With a loose mass, which may strike while it
/// lasts, or draw by its friction to either side in turn, chatter isn't summed.
template <class Loop, class Number>
[[nodiscard]] bool fades(const Loop& loop, const motion::State<Number>& state, const motion::Stop<Number>& stop) {
  using std::abs;
  const Number force = contact_force(loop.constants(), stop, loop.phase(state)).force + stop.into(loop.push(state)),
               rebound = abs(state.v);
  const bool is_struck = state.loose.wall != Side::none && state.loose.place == 0;
  if (!(force > 0) && !is_struck && !loop.walls().is_rough()) return false;
  if (2 * rebound <= force * epsilon<Number>() * loop.period()) return true;
  return loop.loses() && rebound <= modes::faded_speed(loop, stop.position);
}
/// A loose mass keeps its own velocity in an impact of the main one, so that it leaves a wall that pressed it.
template <class Number>
void keep_on(motion::State<Number>& state, const Number& before) {
  if (state.loose.wall == Side::none || state.v == before) return;
  state.loose.speed += before - state.v;
  state.loose.pressed = state.loose.may_part = false;
}
/// An impact on a rigid stop, and the sum of the chatter that may follow.
template <class Loop, class Stage>
[[nodiscard]] Outcome impact(Loop& loop, Stage& stage, const motion::Stop<typename Loop::Number>& stop) {
  using Number = typename Loop::Number;
  motion::State<Number>& state = stage.state;
  const Number before = state.v;
  reverse(state, stop);
  if (before != 0) stage.show_impact(stop, before);
  if constexpr (Loop::effects.loose) {
    if (Loop::effects.rest && state.v != 0 && fades(loop, state, stop)) {
      stage.show_chatter(state, stop, Number(0), Number(0));
      state.v = 0;
    }
    keep_on(state, before);
    if (state.loose.within && !push_wall_anew(loop, stage)) return Outcome::event_budget;
  } else if constexpr (Loop::effects.rest) {
    if (const auto left = state.v != 0 ? loop.chatter_time(state, stop) : std::nullopt) {
      state.chatters = true;
      if (!(state.phase_turns + *left / loop.period() >
            stage.end)) {  // else its state at the end isn't known: it flies
        stage.show_chatter(state, stop, Number(*left / loop.period()), Number(0));
        complete_chatter(loop, state, *left);
      }
    }
  }
  return before == 0 || loop.count_impact() ? Outcome::completed : Outcome::event_budget;
}
/// The begin of a contact with a soft stop, at its position. A mass that only touches, without speed, flies on.
template <class Loop, class Stage>
[[nodiscard]] Outcome touch(Loop& loop, Stage& stage, Side side) {
  auto& state = stage.state;
  state.from_stop = side, state.offset = 0;
  if (state.v == 0) return Outcome::completed;
  state.within = side, state.pressed = true;
  stage.show_contact(motion::Event::Kind::touch, side);
  return loop.count_impact() ? Outcome::completed : Outcome::event_budget;
}
/// A mass meets a stop.
template <class Loop, class Stage>
[[nodiscard]] Outcome meet(Loop& loop, Stage& stage, const motion::Stop<typename Loop::Number>& stop) {
  if constexpr (Loop::effects.soft)
    if (is_soft(loop.stops(), stop.side)) return touch(loop, stage, stop.side);
  return impact(loop, stage, stop);
}

/// A mass without speed enters the soft stop that it is on.
template <class Number>
void enter(motion::State<Number>& state, Side side) {
  state.offset = 0, state.from_stop = state.within = side, state.pressed = true;
}
/// Leaves the region beyond a soft stop's position.
template <class Number>
void leave(motion::State<Number>& state, const motion::SoftStop<Number>& stop) {
  state.x = stop.position, state.offset = 0, state.within = Side::none, state.pressed = false;
}
/// The end of a contact with a soft stop. Without a damper the stop's force falls to 0 at its position.
template <class Stage, class Number>
void separate(Stage& stage, const motion::SoftStop<Number>& stop) {
  stage.state.pressed = false;
  stage.show_contact(motion::Event::Kind::separation, stop.side);
  if (stop.damping == 0 || !(stop.into(stage.state.offset) > 0)) leave(stage.state, stop);
}
/// A soft stop that relaxes pushes a mass again that is beyond its position.
template <class Loop, class Stage>
[[nodiscard]] Outcome renew(Loop& loop, Stage& stage, Side side) {
  stage.state.pressed = true;
  stage.show_contact(motion::Event::Kind::renewal, side);
  return loop.count_impact() ? Outcome::completed : Outcome::event_budget;
}

/// Leaves a mass where it is for some turns, up to the phase `until`, unless a loose mass strikes before.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome stay(Loop& loop, Stage& stage, Side side, const Number& turns, const Number& until, bool held) {
  if constexpr (Loop::effects.loose) return modes::stay_in_housing(loop, stage, side, until, held);
  stage.show_rest(side, turns, held);
  stage.state.phase_turns = until;
  return Outcome::completed;
}
/// Holds a mass until a release, or up to the end of the stage.
template <class Loop, class Stage, class Number>
[[nodiscard]] Outcome hold(Loop& loop, Stage& stage, Side side, const std::optional<Number>& release) {
  auto& state = stage.state;
  const Number until = release ? *release : stage.end;
  const Outcome outcome = stay(loop, stage, side, Number(until - state.phase_turns), until, true);
  if (release && state.v == 0 && state.phase_turns == until) state.released = true, state.loose.may_part = true;
  return outcome;
}
/// Moves a mass at rest past an instant at which the force that holds it is zero to rounding, so its sign decides
/// nothing. After sqrt(epsilon) of a period it is clear of rounding; the mass moves by far less than an ulp.
template <class Loop, class Stage>
[[nodiscard]] Outcome wait(Loop& loop, Stage& stage, Side side) {
  using std::min, std::sqrt;
  using Number = typename Stage::Number;
  const Number turns = min(Number(stage.end - stage.state.phase_turns), Number(sqrt(epsilon<Number>())));
  const Outcome outcome = stay(loop, stage, side, turns, Number(stage.state.phase_turns + turns), false);
  stage.state.released = false;
  return outcome;
}

}  // namespace laws

}  // namespace clatter::stepping
