#pragma once

#include <cstddef>
#include <string>

#include "accuracy/accuracy.hpp"
#include "sweep/sweep.hpp"

namespace clatter::app {

/// The study of a point as a table for people.
[[nodiscard]] std::string accuracy_text(const accuracy::PointAccuracy& study, const sweep::Sweep& sweep,
                                        std::size_t point);

/// The study of a point as JSON lines: one object per row.
[[nodiscard]] std::string accuracy_json(const accuracy::PointAccuracy& study, const sweep::Sweep& sweep,
                                        std::size_t point);

}  // namespace clatter::app
