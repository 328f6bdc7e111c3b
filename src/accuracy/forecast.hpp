#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "accuracy/tested_method.hpp"

namespace clatter::accuracy {

/// How long the rest of a study takes. Its trials differ by a factor of a million and the dearest come late, so that
/// the pace of those before says nothing: of each method a setting is foretold from the one before it.
class Forecast {
 public:
  /// Each trial is run once, and then measured in a round that warms up and so many more.
  Forecast(const std::vector<Trial>& trials, int rounds);

  /// A trial has run for the first time, and all is observed.
  void ran(std::size_t row, double seconds);
  /// A trial has been measured in a round, -1 the first, or left out; a silent run of it takes so long, 0: it never
  /// runs.
  void measured(std::size_t row, int round, double seconds);

  /// Nothing as long as no trial of each dear method has run.
  [[nodiscard]] std::optional<double> seconds_left() const;

 private:
  struct Row {
    Trial trial;
    std::optional<double> first{}, silent{};  ///< seconds
    int next_round = -1;
  };

  [[nodiscard]] std::optional<double> foretold(std::size_t row) const;

  std::vector<Row> rows_;
  int rounds_;
};

}  // namespace clatter::accuracy
