#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "accuracy/run_record.hpp"

namespace clatter::accuracy {

/// The part of a run over which its events in double agree with those in 50 digits.
struct Agreement {
  std::vector<Event> events{};  ///< impacts and rests of the 50-digit run that the one in double has too
  double until = 0.0;           ///< tau; the whole duration if they agree to the end
};

/// Follows both runs until they differ: in a stop, in the kind of an event, or in a time by more than `tolerance`.
/// Impacts that 50 digits still take once a double has completed a chatter are left out, and a chatter begins when the
/// double completes it.
[[nodiscard]] Agreement agreement_of(const RunRecord& in_double, const RunRecord& in_fifty_digits, double tolerance);

/// The differences of the contacts and rests of a run from those of a reference.
struct ContactErrors {
  double time = 0.0;             ///< largest error of an impact's time, in tau
  double speed = 0.0;            ///< largest error of an impact's speed, over the largest speed
  double rest = 0.0;             ///< largest error of a rest's beginning or end, in tau
  std::size_t paired = 0;        ///< impacts that both have; if there are none, time and speed are meaningless
  std::size_t rests_paired = 0;  ///< rests that both have
  std::size_t missed = 0;        ///< impacts of the reference that the run doesn't have
  std::size_t extra = 0;         ///< impacts of the run that the reference doesn't have
  std::size_t rests_missed = 0;  ///< rests of the reference during which the run never rests on that stop
};

/// Pairs the impacts of each stop in their order. A run may lag behind its reference by its lag at the impact before
/// plus half the time to the neighbouring impacts of the stop, in total by up to `latest`: a sequence that comes too
/// late as a whole is late, not missed. Impacts that one run takes while the other completes a chatter are neither
/// missed nor extra.
[[nodiscard]] ContactErrors compare(std::span<const Event> run, std::span<const Event> reference, double latest);

}  // namespace clatter::accuracy
