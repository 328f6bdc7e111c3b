#pragma once

#include <cstddef>
#include <string>

#include "accuracy/run_record.hpp"

namespace clatter::support {

/// The deviation of a run from its reference. Impacts that the reference takes after the run has completed a chatter
/// don't count.
struct Deviation {
  bool same_events = false;  ///< the same impacts, rests, sticks and reversals, on the same stops, in the same order
  std::string difference{};  ///< the first one that is not
  std::size_t impacts = 0, chatters = 0, rests = 0, reversals = 0;  ///< paired ones; rests include sticks
  double time = 0.0;   ///< largest error of a time, over the length of the run
  double speed = 0.0;  ///< largest error of an impact's speed, over the largest speed
  double place = 0.0;  ///< largest error of the place of a stick or reversal, over the largest such place
  double end = 0.0;    ///< error of displacement and velocity at the end, over the largest of each

  [[nodiscard]] double largest() const;
};

[[nodiscard]] Deviation deviation(const accuracy::RunRecord& record, const accuracy::RunRecord& reference);

/// The effect of the inputs' own rounding on a run: the largest deviation of the reference when all inputs are moved by
/// one ulp, in two combinations of signs; infinite if that changes the events.
[[nodiscard]] double conditioning(const point::Problem& scene, const accuracy::RunRecord& reference);

/// The configuration that replays a scene, for a failing test to print.
[[nodiscard]] std::string configuration_of(const point::Problem& scene, double duration);

}  // namespace clatter::support
