#pragma once

#include <cstdint>

#include "scene/stops.hpp"

namespace clatter::motion {

/// A loose mass in its housing. Once it has left a wall it counts from that, so that a flight that a section cuts keeps
/// its digits; before, by its own displacement y, so that one which stands stays exactly there.
template <class Number>
struct LooseState {
  Side wall = Side::none;  ///< the wall that it left last, or that presses it; none: it has met neither
  Number place{};          ///< z less the place of that wall; without one y
  Number speed{};          ///< z'; without such a wall y'
  bool pressed = false;    ///< the wall presses it, so that it moves with the main mass
};

/// The state of a run. Time is a forcing phase and a whole number of periods, so that no growing tau stands inside a
/// sine. Sections (stroboscopic sections) are the instants a whole number of forcing periods, without forcing of 2 pi,
/// after the start.
template <class Number>
struct State {
  Number x{};                   ///< displacement
  Number v{};                   ///< velocity
  Number phase_turns{};         ///< forcing periods since the last section, 0 ... 1
  std::int64_t periods = 0;     ///< sections passed
  bool released = false;        ///< a stop releases the mass at this instant: v = 0 and the acceleration is exactly 0;
                                ///< or friction does, at its static level
  Side from_stop = Side::none;  ///< the stop that the present flight began on
  Number offset{};              ///< x minus the position of that stop: keeps the digits of a flight that a section cuts
  Side within = Side::none;     ///< the soft stop beyond whose position the mass is; then also `from_stop`
  bool pressed = false;         ///< that stop pushes the mass; false: the mass outruns it
  bool chatters = false;        ///< flies in a chatter that is summed, so its impacts aren't told
  LooseState<Number> loose{};   ///< of a loose mass, if there is one; `released`: its wall releases it
  Number reach{};               ///< under friction: the longest way ahead in the present flight, by which its rounding
                                ///< is judged wherever a section cuts it
};

/// Motion at one instant of an arc.
template <class Number>
struct Motion {
  Number offset;        ///< x minus the arc's anchor: keeps its relative accuracy on the shortest flights
  Number x;             ///< displacement
  Number v;             ///< velocity
  Number a;             ///< acceleration
  Number sine, cosine;  ///< of the forcing phase
  Number free_x{};      ///< the transient's part of x, at resonance x - load; kept apart, since it fades below rounding
  Number free_v{};      ///< the transient's part of v, kept apart for the same reason
  Number fast_x{};      ///< heavy damping: the fast mode's part of free_x, kept apart for the same reason
};

/// One impact, as it is reported to observers.
struct Impact {
  double time;         ///< tau since observation began
  Side side;           ///< the stop that is hit
  double before;       ///< velocity before
  double after;        ///< velocity after
  double position;     ///< of the stop
  double turns = 0.0;  ///< forcing periods since the section before it, 0 ... 1
};

/// An impact of a loose mass on a wall of its housing, as it is reported to observers.
struct Strike {
  double time;               ///< tau since observation began
  Side side;                 ///< the wall that is hit
  double before, after;      ///< z'
  double wall;               ///< z
  double v_before, v_after;  ///< velocity of the main mass
  double place;              ///< displacement of the main mass
  double turns = 0.0;        ///< forcing periods since the section before it, 0 ... 1

  /// The same as an impact of the motion in the housing, and of that of the main mass.
  [[nodiscard]] Impact in_housing() const { return {time, side, before, after, wall, turns}; }
  [[nodiscard]] Impact of_main() const { return {time, side, v_before, v_after, place, turns}; }
};

/// A loose mass comes to rest on a wall, which presses it from here on, as it is reported to observers. The rest of its
/// chatter is lost at once.
struct Press {
  double time;               ///< tau since observation began
  Side side;                 ///< the wall
  double speed;              ///< z' that is lost, within rounding of the motion
  double v_before, v_after;  ///< velocity of the main mass
  double place;              ///< displacement of the main mass
};

/// The beginning of a contact with a soft stop, as it is reported to observers.
struct Touch {
  double time;         ///< tau since observation began
  Side side;           ///< the stop
  double velocity;     ///< of the mass
  double position;     ///< of the stop
  bool from_outside;   ///< the mass passes that position; false: beyond it, it meets a stop that it had outrun
  double turns = 0.0;  ///< forcing periods since the section before it, 0 ... 1
};

/// The end of a contact with a soft stop: its force falls to 0.
struct Separation {
  double time;      ///< tau since observation began
  Side side;        ///< the stop
  double velocity;  ///< of the mass
};

/// The velocity of a mass that slips falls to 0 and changes its sign at once, as it is reported to observers.
struct Reversal {
  double time;           ///< tau since observation began
  double position;       ///< of the mass
  double before, after;  ///< its acceleration, which friction makes jump
};

/// A time on a stop, or a stick anywhere, as it is reported to observers.
struct Rest {
  double time;      ///< its beginning: tau since observation began
  double length;    ///< in tau
  Side side;        ///< of the stop; none: friction alone holds the mass, it sticks
  double position;  ///< of the mass
  bool held;        ///< at rest; false: the summed end of a chatter, or a part of it if a section cuts it, or a force
                    ///< within rounding of 0: too low to be told from rest
  double v_begin = 0.0, v_end = 0.0;  ///< velocities at its ends; not 0 within a chatter

  [[nodiscard]] bool is_stick() const { return side == Side::none; }
};

}  // namespace clatter::motion
