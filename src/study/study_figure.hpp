#pragma once

#include <span>
#include <vector>

#include "study/study.hpp"
#include "sweep/figure.hpp"
#include "sweep/sweep.hpp"

namespace clatter {

/// A variable of a study over its rows, and where a row has it.
struct RowVariable {
  const char *name, *long_name;
  double StudyRow::*value;
};

/// A variable of a study over its points.
struct PointVariable {
  const char *name, *long_name;
  double PointStudy::*value;
};

/// All of them, in the order of the file.
[[nodiscard]] std::span<const RowVariable> row_variables();
[[nodiscard]] std::span<const PointVariable> point_variables();

/// The variables of a study of every point of a sweep: the sweep's axes and `row`; errors and times over both.
[[nodiscard]] Figure study_figure(const Sweep& sweep, const std::vector<PointStudy>& points);

}  // namespace clatter
