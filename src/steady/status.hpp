#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "stepping/integration.hpp"

namespace clatter::steady {

/// Status of a point; from `event_budget` on it has failed.
enum class Status : std::uint8_t {
  periodic = 0,
  aperiodic = 1,
  transient = 2,
  grazing = 3,    ///< periodic, but touches a stop within rounding: its stability doesn't exist
  undecided = 4,  ///< rounding decides its period: so much does it stretch changes, and 50 digits don't tell either
  creeping = 5,   ///< comes ever closer, ever more slowly, to a place at which dry friction holds it, and never there
  event_budget = 16,
  not_finite = 17,
  unresolved = 18,
  escaped = 19  ///< no stop and no spring brings the mass back, or an undamped resonance grows for ever
};

/// A status, its name in files, and its meaning in words, after "the point".
struct StatusName {
  Status status;
  std::string_view name, meaning;
};

/// Every status, in the order of its numbers.
inline constexpr std::array<StatusName, 10> status_names{
    {{Status::periodic, "periodic", "repeats; one period is observed"},
     {Status::aperiodic, "aperiodic", "did not repeat within max_periods; a window is observed"},
     {Status::transient, "transient", "was observed from the start"},
     {Status::grazing, "grazing", "is periodic but touches a stop, so its derivatives don't exist"},
     {Status::undecided, "undecided", "has no known period: rounding would decide it, even in 50 digits"},
     {Status::creeping, "creeping", "creeps ever more slowly to a place where dry friction holds it; that is observed"},
     {Status::event_budget, "event_budget", "failed: more than max_impacts"},
     {Status::not_finite, "not_finite", "failed: numbers beyond the range of double"},
     {Status::unresolved, "unresolved", "failed: lengths or times too far apart for double"},
     {Status::escaped, "escaped",
      "failed: nothing brings the mass back, or undamped motion without stops grows at resonance"}}};

[[nodiscard]] constexpr bool failed(Status status) { return status >= Status::event_budget; }

/// Whether a window of the motion is observed, since no period of it is known.
[[nodiscard]] constexpr bool lacks_period(Status status) {
  return status == Status::aperiodic || status == Status::undecided;
}

/// The status of a run that an integrator could not complete.
[[nodiscard]] constexpr Status status_of(stepping::Outcome failure) {
  switch (failure) {
    case stepping::Outcome::event_budget:
      return Status::event_budget;
    case stepping::Outcome::not_finite:
      return Status::not_finite;
    default:
      return Status::unresolved;
  }
}

}  // namespace clatter::steady
