#pragma once

#include <cstdint>
#include <limits>

#include "model/oscillator.hpp"
#include "stepping/integrator.hpp"

namespace clatter::steady {

enum class Mode : std::uint8_t { steady, transient };

/// How long a scene is run and when its motion counts as repeated. "Periods" are forcing periods, 2 pi / nu; without
/// forcing, 2 pi.
struct TimeSettings {
  Mode mode = Mode::steady;
  std::int64_t max_periods = 5000;  ///< periods after which settling is given up, >= 1
  std::int64_t window = 64;         ///< periods observed of a motion that does not repeat, >= 1
  double duration = 0.0;            ///< transient: observed time in tau, > 0
  double tolerance = 1e-12;         ///< distance of the states at a repeat, relative to the larger of |x| and |v|
  double max_impacts = 1e8;         ///< impacts after which a point is given up (event_budget)
};

/// The time in tau during which a stop may be met: of a steady motion all time, since nobody knows how long it takes.
[[nodiscard]] constexpr double duration_of(const TimeSettings& time) {
  return time.mode == Mode::steady ? std::numeric_limits<double>::infinity() : time.duration;
}

/// What a run of an oscillator may come to.
[[nodiscard]] constexpr stepping::Limits limits_of(const TimeSettings& time, const Oscillator& oscillator) {
  const double periods =
      time.mode == Mode::transient ? time.duration / period_of(oscillator) : static_cast<double>(time.max_periods);
  return {time.max_impacts, periods};
}

}  // namespace clatter::steady
