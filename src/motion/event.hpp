#pragma once

#include <cmath>
#include <cstdint>

#include "motion/state.hpp"

namespace clatter::motion {

/// An event of a motion, as it is recorded.
struct Event {
  enum class Kind : std::uint8_t {
    impact,      ///< on a rigid stop
    rest,        ///< on a rigid stop begins
    chatter,     ///< its end is summed, or the force within rounding of 0 is waited for: `Rest` not held
    touch,       ///< of a soft stop at its position, where contact begins
    renewal,     ///< of the contact with a soft stop, whose force rises from zero, beyond its position
    separation,  ///< from a soft stop, whose force falls to zero
    stick,       ///< of a slip, away from rigid stops, begins: `Rest` without a side
    reversal,    ///< of a slip, whose velocity passes 0
  };
  Kind kind = Kind::impact;
  Side side = Side::none;
  double time = 0.0;      ///< tau
  double velocity = 0.0;  ///< before it; 0 at rest
  double length = 0.0;    ///< of a rest, a stick or a chatter's end, tau
  double after = 0.0;     ///< velocity after an impact
  double place = 0.0;     ///< displacement of a stick or a reversal

  [[nodiscard]] double end() const { return time + length; }
  [[nodiscard]] double speed() const { return std::abs(velocity); }
};

/// The events of which observers are told.
[[nodiscard]] inline Event event_of(const Impact& impact) {
  return {Event::Kind::impact, impact.side, impact.time, impact.before, 0.0, impact.after};
}
[[nodiscard]] inline Event event_of(const Rest& rest) {
  if (rest.is_stick()) return {Event::Kind::stick, Side::none, rest.time, 0.0, rest.length, 0.0, rest.position};
  return {rest.held ? Event::Kind::rest : Event::Kind::chatter, rest.side, rest.time, 0.0, rest.length};
}
[[nodiscard]] inline Event event_of(const Reversal& reversal) {
  return {Event::Kind::reversal, Side::none, reversal.time, 0.0, 0.0, 0.0, reversal.position};
}
[[nodiscard]] inline Event event_of(const Touch& touch) {
  return {touch.from_outside ? Event::Kind::touch : Event::Kind::renewal, touch.side, touch.time, touch.velocity};
}
[[nodiscard]] inline Event event_of(const Separation& separation) {
  return {Event::Kind::separation, separation.side, separation.time, separation.velocity};
}

}  // namespace clatter::motion
