#pragma once

#include <cstdint>
#include <limits>

#include "scene/oscillator.hpp"
#include "stepping/integration.hpp"

namespace clatter::steady {

enum class Mode : std::uint8_t { steady, transient };

/// The time for which a scene is run, and the tolerance of repeats. "Periods" are forcing periods, 2 pi / nu; without
/// forcing, 2 pi.
struct TimeSettings {
  Mode mode = Mode::steady;
  std::int64_t max_periods = 5000;  ///< periods after which the search for steady motion ends, >= 1
  std::int64_t window = 64;         ///< periods observed of a motion that does not repeat, >= 1
  double duration = 0.0;            ///< transient: observed time in tau, > 0
  double tolerance = 1e-12;         ///< distance of the states at a repeat, relative to the larger of |x| and |v|
  double max_impacts = 1e8;         ///< impacts after which a point fails (event_budget)
};

/// The time in tau during which a stop may be met: in steady mode infinite, since the settling time isn't known before.
[[nodiscard]] constexpr double duration_of(const TimeSettings& time) {
  return time.mode == Mode::steady ? std::numeric_limits<double>::infinity() : time.duration;
}

/// The limits of a run of an oscillator.
[[nodiscard]] constexpr stepping::Limits limits_of(const TimeSettings& time, const Oscillator& oscillator) {
  const double periods =
      time.mode == Mode::transient ? time.duration / period_of(oscillator) : static_cast<double>(time.max_periods);
  return {time.max_impacts, periods};
}

}  // namespace clatter::steady
