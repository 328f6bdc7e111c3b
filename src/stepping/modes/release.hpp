#pragma once

#include <optional>

#include "motion/dry_friction.hpp"

namespace clatter::stepping {

/// When a mass is let go that something holds, and all else that modes share.
namespace modes {

/// A phase of the force, counted from the section: in turns, 0 ... 1.
template <class Loop, class Number>
[[nodiscard]] std::optional<Number> in_section(const Loop& loop, const std::optional<Number>& phase) {
  if (!phase) return std::nullopt;
  return part_of_turn(Number(*phase - loop.start_turns()));
}
/// The phase at which a stop releases a mass, in turns since the section, 0 ... 1: the same number after every rest.
/// Of a force in pieces within that of the phase `from`, counted likewise.
template <class Loop, class Number>
[[nodiscard]] std::optional<Number> release_turns(const Loop& loop, const motion::Stop<Number>& stop,
                                                  const Number& from) {
  const Number turns = loop.start_turns() + from;
  if constexpr (Loop::effects.friction)
    if (loop.is_rough()) {
      motion::State<Number> state;
      state.x = stop.position;
      return in_section(loop, loop.holding_at(state).release_phase(loop.constants(), opposite(stop.side), turns));
    }
  return in_section(loop, release_phase(loop.constants(), stop, turns));
}
/// Whether a knot of the force, in turns since the section, releases a mass from where it is held.
template <class Loop, class Number>
[[nodiscard]] bool is_releasing_knot(const Loop& loop, motion::State<Number> state, const Number& knot) {
  const auto is_held = [&](const Number& turns) {
    state.phase_turns = turns;
    return loop.holding_stop(state).has_value();
  };
  const Number shortly = 64 * knot_rounding<Number>();
  return is_held(Number(knot - shortly)) && !is_held(knot);
}
/// A release at a phase if it is ahead and not beyond `end`. Just behind it is now, to rounding.
template <class Number>
[[nodiscard]] std::optional<Number> upcoming(const std::optional<Number>& release, const Number& now,
                                             const Number& end) {
  if (!release) return std::nullopt;
  const Number ahead = *release - now + (*release < now ? 1 : 0);
  const Number at = ahead > 1 - 16 * epsilon<Number>() ? now : *release;
  return at >= now && at <= end ? std::optional(at) : std::nullopt;
}

}  // namespace modes

}  // namespace clatter::stepping
