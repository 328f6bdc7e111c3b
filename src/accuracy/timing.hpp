#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

#include "point/point.hpp"

namespace clatter::accuracy {

/// Measures wall times of a trial.
class Timing {
 public:
  /// Runs a trial often enough to measure its time; a slow one is measured in the first rounds only. `run(times)` runs
  /// it so many times and returns the forcing periods of all.
  void measure(const std::function<double(int times)>& run, int round) {
    if (is_left_out(seconds_, round)) return;
    const auto begin = std::chrono::steady_clock::now();
    const double periods = run(batch_);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    seconds_ = seconds / batch_;
    if (round >= 0) ns_per_period_.push_back(1e9 * seconds / periods);
    batch_ = static_cast<int>(std::clamp(shortest / seconds_, 1.0, 1e6));
  }
  /// Seconds of one run, as last measured.
  [[nodiscard]] double seconds() const { return seconds_; }
  /// Seconds that a measurement of a trial takes in a round, by the seconds of one run, 0 if it never runs.
  [[nodiscard]] static double lasts(double seconds, int round) {
    if (seconds == 0 || is_left_out(seconds, round)) return 0;
    return round < 0 ? seconds : std::max(shortest, seconds);
  }

  [[nodiscard]] double median() { return quantile(0.5); }
  [[nodiscard]] double spread() {
    return ns_per_period_.size() > 1 ? quantile(0.75) - quantile(0.25) : point::no_value;
  }

 private:
  static constexpr double shortest = 2e-3;  // seconds

  [[nodiscard]] static bool is_left_out(double seconds, int round) {
    return (round > 0 && seconds > 5) || (round > 2 && seconds > 1);
  }

  [[nodiscard]] double quantile(double share) {
    if (ns_per_period_.empty()) return point::no_value;
    std::ranges::sort(ns_per_period_);
    const double position = share * static_cast<double>(ns_per_period_.size() - 1);
    const auto below = static_cast<std::size_t>(position), above = std::min(below + 1, ns_per_period_.size() - 1);
    return std::lerp(ns_per_period_[below], ns_per_period_[above], position - std::floor(position));
  }

  int batch_ = 1;
  double seconds_ = 0.0;
  std::vector<double> ns_per_period_;
};

}  // namespace clatter::accuracy
