#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {

/// The variables of a file with a value for each motion that starts end in, and those of its shares. Throws ChoiceError
/// if it has none.
[[nodiscard]] std::vector<std::string> motion_variables(const results::FileSummary& summary, const std::string& path);

/// Which of the motions that starts end in each point has. A dataset holds `attractor`.
class MotionRows {
 public:
  /// Throws IoError if the numbers of motions are none of the file.
  MotionRows(const results::FileSummary& summary, const std::string& path, const results::Dataset& dataset);

  /// The number of each point's motion; 0 of points without one.
  [[nodiscard]] std::vector<std::size_t> motion_of_points() const;

  /// The index of each point in the shares, which are over the parameters and the motions.
  [[nodiscard]] std::vector<std::size_t> share_of_points() const;

  /// Keeps, of the chosen points, at each value of the parameters the first that ends in each motion.
  void keep_first(std::vector<bool>& chosen) const;

 private:
  [[nodiscard]] bool has_motion(std::size_t point) const { return numbers_[point] >= 0; }

  std::vector<std::int32_t> numbers_;     ///< of the motion of each point, -1: none
  std::vector<std::size_t> parameters_;   ///< the index of each point among the values of the parameters
  std::size_t motions_ = 0, values_ = 1;  ///< counts of motions, and of values of the parameters
};

}  // namespace clatter::app
