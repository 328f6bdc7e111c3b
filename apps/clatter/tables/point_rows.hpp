#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "results/dataset.hpp"

namespace clatter::app {

/// The results of points, each found by the index of its point: variables over the dimensions of the points or over
/// more, the log of impacts, and the motions that the points end in.
class PointRows {
 public:
  /// The results in a dataset of so many points, whose dimensions these are.
  PointRows(results::Dataset dataset, std::vector<std::string> dimensions, std::size_t points);

  /// The results of some points alone, which are counted anew; `read` gives their variables a group at a time.
  [[nodiscard]] static PointRows chosen(const std::vector<std::vector<std::string>>& groups,
                                        std::vector<std::string> dimensions, std::size_t points,
                                        const std::vector<std::size_t>& chosen,
                                        const std::function<results::Dataset(const std::vector<std::string>&)>& read);

  [[nodiscard]] const results::Dataset& dataset() const { return dataset_; }
  /// The variable of a name; nullptr: there is none.
  [[nodiscard]] const results::Variable* find(std::string_view name) const;
  /// Whether a variable holds results of points.
  [[nodiscard]] bool has_rows(const results::Variable& variable) const;

  /// Where the values of a point lie in a variable; for one of motions, those of the point's motion.
  struct Row {
    std::size_t first = 0, count = 0;  ///< none if the point has none there
  };
  [[nodiscard]] Row row(const results::Variable& variable, std::size_t point) const;

 private:
  results::Dataset dataset_;
  std::vector<std::string> dimensions_;
  std::size_t points_;
  std::vector<std::size_t> logged_{};  ///< [point]: impacts in the log before it, the last one: of all points
};

}  // namespace clatter::app
