#pragma once

#include <cstddef>
#include <string>

#include "study/study.hpp"
#include "sweep/sweep.hpp"

namespace clatter {

/// The study of a point as a table for people.
[[nodiscard]] std::string study_text(const PointStudy& study, const Sweep& sweep, std::size_t point);

/// The study of a point as one JSON object a line and row.
[[nodiscard]] std::string study_json(const PointStudy& study, const Sweep& sweep, std::size_t point);

}  // namespace clatter
