#pragma once

#include <optional>
#include <span>

#include "accuracy/accuracy.hpp"

namespace clatter::accuracy {

/// The largest error of a row in times, speeds, rests and extrema, as far as it has them; NaN if it has none, failed,
/// or missed or invented an impact: a motion with other impacts is another motion.
[[nodiscard]] double error_of(const WorkPrecision& row);

/// The row of a method, in lanes or in the scalar loop, that reaches an error in the least time a period; null if none
/// does.
[[nodiscard]] const WorkPrecision* cheapest(std::span<const WorkPrecision> rows, TestedMethod method, bool in_lanes,
                                            double error);

/// The finest setting of a method in the scalar loop at which it misses or invents impacts; nothing if none does.
[[nodiscard]] std::optional<double> misses_from(std::span<const WorkPrecision> rows, TestedMethod method);

}  // namespace clatter::accuracy
