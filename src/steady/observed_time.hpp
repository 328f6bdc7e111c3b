#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "motion/state.hpp"
#include "steady/status.hpp"

namespace clatter::steady {

/// The way in which the time to observe was found.
enum class FoundBy : std::uint8_t {
  start,        ///< a transient is observed from its start
  closed_form,  ///< no stop in reach: the steady response, or free vibration
  energy,       ///< conservative motion: the period follows from the start
  newton,       ///< Newton's method on the stroboscopic map
  repetition,   ///< the state came back
  standstill,   ///< nothing moves any more
  nothing,      ///< the motion doesn't repeat, or the point has failed
  rests,        ///< no repeat among those that are looked for, but a stop releases the mass time and again
  creep         ///< it is proved to come ever closer to where dry friction holds the mass
};

/// Names for output, in the order of FoundBy.
inline constexpr std::array<const char*, 9> found_by_names{
    "transient",  "closed form", "energy",    "Newton's method",
    "repetition", "standstill",  "no repeat", "probable repeat beyond 64 periods",
    "creep"};

/// Whether a mass of which an end is observed stands.
[[nodiscard]] constexpr bool stands_still(FoundBy found_by) {
  return found_by == FoundBy::standstill || found_by == FoundBy::creep;
}

/// The time that is observed: its first state, its length, and the kind of its motion.
struct ObservedTime {
  Status status = Status::unresolved;
  motion::State<double> from{};
  double turns = 0.0;      ///< its length in forcing periods; without forcing in 2 pi
  double simulated = 0.0;  ///< forcing periods simulated before, to find it
  FoundBy found_by = FoundBy::nothing;
  /// Forcing periods until the motion from the start is within the tolerance of its steady state, by the rate at which
  /// it contracts; may exceed max_periods. NaN if there is no steady state.
  double settling = std::numeric_limits<double>::quiet_NaN();
  /// Rounding may have decided this: motion of a long period, that stretches changes much, or that rests.
  bool doubtful = false;
  Side rested_on = Side::none;  ///< the stop that last held a mass whose motion doesn't repeat
  /// If not empty, the states at the sections of a periodic motion, known better than by running on from the first:
  /// each forcing period is observed from its own.
  std::vector<motion::State<double>> sections{};
};

/// The end of a search for motion that is proved to escape from a state, after so many simulated periods.
[[nodiscard]] inline ObservedTime escape(const motion::State<double>& state, double simulated) {
  return {Status::escaped, state, 0.0, simulated, FoundBy::nothing};
}

}  // namespace clatter::steady
