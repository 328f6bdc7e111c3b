#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "steady/map_orbit.hpp"
#include "steady/observed_time.hpp"
#include "steady/time_settings.hpp"

namespace clatter::steady {

/// The last rest of a motion.
struct Rests {
  Side on = Side::none;       ///< the stop
  std::int64_t section = -1;  ///< before it

  /// Takes the summary of the forcing period from a section on.
  void pass(const Passage& passage, std::int64_t from) {
    if (passage.rested_on != Side::none) on = passage.rested_on, section = from;
  }
};

/// Forcing periods from which on a motion is doubtful: over fewer, changes are hardly stretched so much that rounding
/// matters.
inline constexpr std::size_t long_period = 4;

/// The end of a search by a repeat after n forcing periods, at a section.
[[nodiscard]] inline ObservedTime repeated(const motion::State<double>& first, std::size_t n, double simulated,
                                           std::int64_t section, const Rests& rests) {
  ObservedTime found{Status::periodic, first, static_cast<double>(n), simulated, FoundBy::repetition};
  found.settling = static_cast<double>(section);
  found.doubtful = n >= long_period || rests.section >= section - static_cast<std::int64_t>(n);
  return found;
}

/// The end of a search without a repeat. Motion that still rests now and then does repeat, since a rest erases the
/// past: its period is too long, or rounding decides it.
[[nodiscard]] inline ObservedTime aperiodic(const motion::State<double>& state, double simulated,
                                            const TimeSettings& time, const Rests& rests) {
  ObservedTime found{Status::aperiodic, state, static_cast<double>(time.window), simulated, FoundBy::nothing};
  found.doubtful = rests.section >= time.max_periods / 2, found.rested_on = rests.on;
  return found;
}

/// Whether a periodic motion stretches changes so much that sections computed from its first have lost digits.
[[nodiscard]] inline bool stretches(const MapOrbit& orbit) {
  constexpr double much = 1e3;
  return std::any_of(orbit.derivatives.begin(), orbit.derivatives.begin() + static_cast<std::ptrdiff_t>(orbit.periods),
                     [](const motion::Jacobian<double>& D) {
                       return std::ranges::any_of(D, [](double entry) { return std::abs(entry) > much; });
                     });
}

}  // namespace clatter::steady
