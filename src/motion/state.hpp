#pragma once

#include <cstdint>

#include "math/number.hpp"
#include "model/stops.hpp"

namespace clatter::motion {

/// Where a run stands. Time is the forcing phase: turns since the last section and whole sections, never a growing tau
/// inside a sine. Sections are the instants a whole number of forcing periods (without forcing: of 2 pi) after the
/// start.
template <class Number>
struct State {
  Number x{};                ///< displacement
  Number v{};                ///< velocity
  Number turns{};            ///< forcing periods since the last section, 0 ... 1
  std::int64_t periods = 0;  ///< sections passed
  bool released = false;     ///< a stop lets the mass go at this instant: v = 0 and the acceleration is exactly 0
  Side left = Side::none;    ///< the stop on which the present flight began
  Number offset{};           ///< x minus the place of that stop: keeps the digits of a flight that a section cuts
};

/// Motion at one instant of an arc.
template <class Number>
struct Motion {
  Number offset;        ///< x minus the arc's anchor: keeps its relative accuracy on the shortest flights
  Number x;             ///< displacement
  Number v;             ///< velocity
  Number a;             ///< acceleration
  Number sine, cosine;  ///< of the forcing phase
  Number free_x{};      ///< the transient's share of the displacement; at resonance all but the load's
  Number free_v{};      ///< and of the velocity: kept apart, since it fades below the rounding of the whole
  Number fast_x{};      ///< heavy damping: the fast mode's share of free_x, for the same reason
};

/// One impact, as observers see it.
struct Impact {
  double time;      ///< tau since observation began
  Side side;        ///< the stop that is hit
  double before;    ///< velocity before
  double after;     ///< velocity after
  double position;  ///< of the stop
};

/// A stretch of time on a stop, as observers see it.
struct Rest {
  double time;    ///< tau since observation began, at its beginning
  double length;  ///< in tau
  Side side;
  double position;  ///< of the stop
  bool held;  ///< at rest; false: the completed rest of a chatter or a force within rounding of 0, too short to move
              ///< any result
};

}  // namespace clatter::motion
