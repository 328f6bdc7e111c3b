#pragma once

#include <cstddef>
#include <string>

#include "accuracy/accuracy.hpp"
#include "sweep/sweep.hpp"

namespace clatter::app {

/// Says over which time of a problem, and with how many events, methods are compared.
[[nodiscard]] std::string comparison_text(const accuracy::PointAccuracy& of_point, const point::Problem& problem);

/// The short answer at a point, then every row as a table.
[[nodiscard]] std::string accuracy_text(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                        std::size_t point);

/// The short answer at a point, in 80 columns: for each error the cheapest setting of each method that reaches it, its
/// time a period and how many times the cheapest that is; a sentence; from which settings on impacts are missed.
[[nodiscard]] std::string accuracy_answer(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                          std::size_t point);

}  // namespace clatter::app
