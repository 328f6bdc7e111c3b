#pragma once

#include <span>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "sweep/dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::accuracy {

/// A variable of a study over its rows, and where a row has it.
struct RowVariable {
  const char *name, *long_name;
  double WorkPrecision::*value;
};

/// A variable of a study over its points.
struct PointVariable {
  const char *name, *long_name;
  double PointAccuracy::*value;
};

/// All of them, in the order of the file.
[[nodiscard]] std::span<const RowVariable> row_variables();
[[nodiscard]] std::span<const PointVariable> point_variables();

/// The variables of a study of every point of a sweep: the sweep's axes and `row`; errors and times over both.
[[nodiscard]] sweep::Dataset accuracy_dataset(const sweep::Sweep& sweep, const std::vector<PointAccuracy>& points);

}  // namespace clatter::accuracy
