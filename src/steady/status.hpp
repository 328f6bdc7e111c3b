#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "stepping/integration.hpp"

namespace clatter::steady {

/// Status of a point; from `event_budget` on it has failed.
enum class Status : std::uint8_t {
  periodic = 0,
  aperiodic = 1,
  transient = 2,
  grazing = 3,    ///< periodic, but touches a stop within rounding: its stability doesn't exist
  undecided = 4,  ///< rounding decides its period: so much does it stretch changes, and 50 digits don't tell either
  event_budget = 16,
  not_finite = 17,
  unresolved = 18,
  escaped = 19  ///< no stop and no spring brings the mass back, or an undamped resonance grows for ever
};

/// Every status and its name.
inline constexpr std::array<std::pair<Status, std::string_view>, 9> status_names{
    {{Status::periodic, "periodic"},
     {Status::aperiodic, "aperiodic"},
     {Status::transient, "transient"},
     {Status::grazing, "grazing"},
     {Status::undecided, "undecided"},
     {Status::event_budget, "event_budget"},
     {Status::not_finite, "not_finite"},
     {Status::unresolved, "unresolved"},
     {Status::escaped, "escaped"}}};

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
