#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "accuracy/tested_method.hpp"

namespace clatter::accuracy {

/// Estimates the time that the rest of an accuracy run takes. Its trials differ by a factor of a million and the
/// costliest come late, so the pace so far says nothing: the time of each setting is extrapolated from the setting
/// before, method by method.
class Forecast {
 public:
  /// Each trial is run once, and then measured in one round to warm up and `rounds` more.
  Forecast(const std::vector<Trial>& trials, int rounds);

  /// Records the first run of a trial, with all observables.
  void ran(std::size_t row, double seconds);
  /// Records the measurement of a trial in a round, -1 the first, or that it was left out; `seconds` is the time of a
  /// run without observables, 0 if the trial never runs.
  void measured(std::size_t row, int round, double seconds);

  /// Nothing until a trial of each costly method has run.
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
