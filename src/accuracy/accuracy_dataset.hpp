#pragma once

#include <span>
#include <vector>

#include "accuracy/accuracy.hpp"
#include "results/dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::accuracy {

/// A variable over the rows of an accuracy run, and its member of a row.
struct RowVariable {
  const char *name, *long_name;
  double WorkPrecision::*value;
};

/// A variable over the points of an accuracy run, and its member of a point.
struct PointVariable {
  const char *name, *long_name;
  double PointAccuracy::*value;
};

/// All variables over rows and over points, in the order of the file.
[[nodiscard]] std::span<const RowVariable> row_variables();
[[nodiscard]] std::span<const PointVariable> point_variables();

/// The dataset of an accuracy run of every point of a sweep: the sweep's axes and `row`; errors and times over both.
[[nodiscard]] results::Dataset accuracy_dataset(const sweep::Sweep& sweep, const std::vector<PointAccuracy>& points);

}  // namespace clatter::accuracy
