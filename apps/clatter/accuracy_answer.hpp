#pragma once

#include <cstddef>
#include <string>

#include "accuracy/accuracy.hpp"
#include "sweep/sweep.hpp"

namespace clatter::app {

/// The short answer at a point, in 80 columns: for each error the cheapest setting of each method that reaches it, its
/// time a period and how many times the cheapest that is; a sentence; from which settings on impacts are missed.
[[nodiscard]] std::string accuracy_answer(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                          std::size_t point);

}  // namespace clatter::app
