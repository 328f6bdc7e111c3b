#pragma once

#include <optional>

#include "flow.hpp"

namespace verify {

enum class Kind {
  impact,
  touch,
  separation,
  renewal,
  graze,
  reversal,
  chatter,
  rest,
  stick,
  press,
  turn,
  hold,
  release,
  end
};

[[nodiscard]] const char* name_of(Kind kind);

/// The derivative of an event's velocity by the state at the start and by the parameter.
struct Slopes {
  Ball by_x, by_v, by_parameter;
};

/// Something that happens to all motions of a set.
struct Event {
  Kind kind = Kind::end;
  Side side = Side::lower;
  Ball time, v;  ///< v: before an impact; of one on a wall of a loose mass z'
  Ball until;    ///< of a chatter, a rest, a stick, a press or a hold
  Ball gap{};    ///< of a graze: the least that is left to the stop, or of its force; below 0 the motion passes through
  Slopes slopes{};
  Ball x{};                 ///< of a reversal or a stick: the place; of a turn or a hold z
  bool of_wall = false;     ///< of a loose mass
  std::size_t release = 0;  ///< of a rest: which of the phases of a turn at which the stop may let go comes next
};

/// Whether a stop holds the mass, or a wall the loose mass.
[[nodiscard]] inline bool holds(Kind kind) { return kind == Kind::rest || kind == Kind::press; }
/// Whether an event has an end of its own, `until`.
[[nodiscard]] inline bool lasts(Kind kind) {
  return holds(kind) || kind == Kind::chatter || kind == Kind::stick || kind == Kind::hold;
}
/// Whether friction alone turns or holds the main mass, or the loose one in its housing.
[[nodiscard]] inline bool is_of_friction(Kind kind) {
  return kind == Kind::reversal || kind == Kind::stick || kind == Kind::turn || kind == Kind::hold;
}

/// The state that a motion starts from.
struct Start {
  Ball time;
  Ball x, v;
  bool released = false;  ///< by a stop, at the phase nearest to `time` at which the force that presses falls to 0
  Side side = Side::lower;
  Ball z{}, w{};                  ///< of a loose mass: its place in the housing, and z'
  std::optional<Side> pressed{};  ///< the wall that presses it
};

/// How well the end of a chatter is to be told.
struct ChatterAim {
  double accuracy;  ///< of the time of its end
  double height;    ///< its flights are followed until the others stay within so much of the stop
  Ball latest;      ///< the latest claimed end: of a chatter that goes on the next event shows it
  Ball end;         ///< of the motion
};

/// A stretch of motion without an event, for those who look into it.
struct Stretch {
  Flow::Flight flight;
  Ball length;
};

}  // namespace verify
