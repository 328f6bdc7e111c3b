#pragma once

#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "results/dataset_file.hpp"

namespace clatter::app {

/// A file whose points are compared: totals over the observed time, which isn't the same at all points (one period of
/// periodic motion, a window of motion without one), are per forcing period if the file tells for how many of them each
/// point was observed, and the long names say so. All else is as in the file.
class Compared {
 public:
  /// Throws IoError if the file can't be read or contradicts itself.
  Compared(results::FileSummary summary, std::string path);

  [[nodiscard]] const results::FileSummary& summary() const { return summary_; }

  /// The values of some variables. Throws IoError.
  [[nodiscard]] results::Dataset read(const std::vector<std::string>& names) const;

  /// "per forcing period" for a total that is so; else empty.
  [[nodiscard]] std::string per(const std::string& name) const;

 private:
  results::FileSummary summary_;
  std::string path_;
  std::vector<double> periods_{};  ///< observed at each point; empty: totals are those of the file
};

}  // namespace clatter::app
