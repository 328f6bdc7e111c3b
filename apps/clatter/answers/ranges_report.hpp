#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answers/ranges.hpp"
#include "terminal/asked_units.hpp"

namespace clatter::app {

/// Ranges for people: a block for each value of the other axes, a line a range, "  LU   15 Hz ... 21.25 Hz, 26 points";
/// of conditions first the points that meet them, of a sample with the interval of their share.
[[nodiscard]] std::string ranges_text(const Ranges& ranges, const std::vector<RangeLine>& lines,
                                      const std::optional<Met>& met, const AskedUnits& asked);

}  // namespace clatter::app
