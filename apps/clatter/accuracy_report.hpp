#pragma once

#include <cstddef>
#include <string>

#include "accuracy/accuracy.hpp"
#include "sweep/sweep.hpp"

namespace clatter::app {

/// The accuracy at a point as a table for people.
[[nodiscard]] std::string accuracy_text(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                        std::size_t point);

/// The accuracy at a point as JSON lines: one object per row.
[[nodiscard]] std::string accuracy_json(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep,
                                        std::size_t point);

}  // namespace clatter::app
