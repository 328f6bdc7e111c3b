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
template <class Loop, class Number>
[[nodiscard]] std::optional<Number> release_turns(const Loop& loop, const motion::Stop<Number>& stop) {
  if constexpr (Loop::effects.friction)
    if (loop.is_rough()) {
      motion::State<Number> state;
      state.x = stop.position;
      return in_section(loop, loop.holding_at(state).release_phase(loop.constants(), opposite(stop.side)));
    }
  return in_section(loop, release_phase(loop.constants(), stop));
}
/// The knot of the force, in turns since the section, that releases a mass from where it is held; nothing: none does.
template <class Loop, class Number>
[[nodiscard]] std::optional<Number> releasing_knot(const Loop& loop, motion::State<Number> state) {
  const auto is_held = [&](const Number& turns) {
    state.phase_turns = turns;
    return loop.holding_stop(state).has_value();
  };
  const Number shortly(1e-9);
  Number knot = loop.next_knot(Number(-1));
  for (; knot < 1; knot = loop.next_knot(knot))
    if (is_held(Number(knot - shortly)) && !is_held(knot)) return knot;
  return std::nullopt;
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
