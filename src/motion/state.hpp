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
  bool released = false;   ///< the wall lets it go at this instant: z' = 0, and z'' is exactly 0
  bool may_part = false;   ///< pressed, but an event of the main mass has just changed its acceleration
  bool within = false;     ///< the wall is soft, and it is beyond its place, or enters it
  bool pushed = false;     ///< that wall pushes both masses apart; false: it relaxes
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
  Number departure{};           ///< velocity relative to that stop, if it moves by itself, for the same reason
  Side within = Side::none;     ///< the soft stop beyond whose position the mass is; then also `from_stop`
  bool pressed = false;         ///< that stop pushes the mass; false: the mass outruns it
  bool chatters = false;        ///< flies in a chatter that is summed, so its impacts aren't told
  LooseState<Number> loose{};   ///< of a loose mass, if there is one
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

}  // namespace clatter::motion
