#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "answers/extremes.hpp"
#include "answers/quantiles.hpp"
#include "answers/ranges.hpp"
#include "answers/told_motions.hpp"
#include "branches/branch.hpp"
#include "config/reading.hpp"
#include "plan/plan.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {

// All that commands print for scripts by --json. It is ASCII: other characters are escaped, those that a terminal obeys
// among them, and bytes that aren't UTF-8 become U+FFFD. A number that isn't finite is null.

/// The summary of a file: attributes, variables with their dimensions, number of points by status, and of a sample the
/// quantiles of its results, of starts the motions that they end in.
[[nodiscard]] std::string summary_json(const results::FileSummary& summary, const std::vector<Quantiles>& quantiles,
                                       const ToldMotions& motions);

/// Ranges of a result, or of points that meet conditions: for each value of the other axes where they begin and end,
/// and how many points meet the conditions, with their share and its 95 % interval.
[[nodiscard]] std::string ranges_json(const Ranges& ranges, const std::vector<RangeLine>& lines,
                                      const std::optional<Met>& met);

/// The points at which a result of a file is largest, or smallest, the best first: for each its value, its axes, which
/// component of the result, and the words for its motion.
[[nodiscard]] std::string extremes_json(const Extremes& extremes, const std::vector<Extreme>& points);

/// A value as it was written: {"value": 0.0015, "units": "m", "unit": "mm"}; without a unit that is null.
[[nodiscard]] std::string reading_json(const config::Reading& reading);

/// A plan, schema "clatter-plan/1" (src/plan/README.md); `seconds` is the time of a run, if it is known.
[[nodiscard]] std::string plan_json(const plan::Plan& plan, const sweep::Sweep& sweep, int threads,
                                    std::optional<double> seconds);

/// The accuracy at a point: a line, with one object, for each row.
[[nodiscard]] std::string accuracy_json(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                        std::size_t point);

/// A special point of a branch: {"kind":"fold","nu":1.42, ... "multipliers":[[1.0,0.0],[0.1,0.0]], ...} in one line;
/// multipliers are pairs of real and imaginary parts. "left_out": a birth there isn't followed.
[[nodiscard]] std::string special_json(const branches::SpecialPoint& special, const std::vector<Parameter>& parameters,
                                       const Units& units, const branches::WordLetters& letters);

}  // namespace clatter::app
