#pragma once

#include <optional>
#include <vector>

#include "certificates/events.hpp"
#include "point/problem.hpp"

namespace clatter::certificates {

/// A motion over some forcing periods, from the start of its problem on.
struct RecordedMotion {
  std::vector<RecordedEvent> events{};  ///< times since the start
  motion::State<double> end{};
  motion::Jacobian<double> derivative{};  ///< from the start to the end
  std::array<double, 2> rounding{};       ///< of all flights but the last, grown to the end, as in `RecordedEvent`
  double duration = 0.0;                  ///< tau
};

/// Records the motion of a problem for a time in forcing periods; if a stop is named, this releases the mass at the
/// start. Nothing if the motion cannot be completed.
[[nodiscard]] std::optional<RecordedMotion> recorded(const point::Problem& problem, double turns,
                                                     Side released = Side::none);

}  // namespace clatter::certificates
