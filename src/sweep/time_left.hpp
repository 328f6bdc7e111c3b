#pragma once

#include <cmath>
#include <optional>

namespace clatter::sweep {

/// Estimates how long the rest of some work takes from its progress so far. Progress in the first half of the time
/// counts a quarter, so slow parts at the beginning are soon forgotten.
class TimeLeft {
 public:
  /// `before` was finished before the time began, and doesn't count as progress.
  explicit TimeLeft(double before = 0) : before_(before), finished_(before) {}

  /// Records what is finished after some seconds, parts of items included.
  void add(double seconds, double finished) {
    if (finished <= finished_ || seconds <= seconds_) return;
    const double old = std::pow(seconds_ / seconds, 2.0);
    rate_ = old * rate_ + (1 - old) * (finished - finished_) / (seconds - seconds_);
    seconds_ = seconds, finished_ = finished, ++times_;
  }

  /// Estimated seconds until `total` is finished; empty as long as there is too little progress. If nothing has been
  /// finished for longer than all of the rest should take, it may take as long again.
  [[nodiscard]] std::optional<double> at(double seconds, double total) const {
    if (finished_ >= total) return 0.0;
    if (seconds < 1 || times_ == 0 || (times_ < 4 && 4 * (finished_ - before_) < total - before_)) return std::nullopt;
    return std::abs((total - finished_) / rate_ - (seconds - seconds_));
  }

 private:
  double before_, finished_, seconds_ = 0;
  double rate_ = 0;  ///< finished a second
  int times_ = 0;    ///< that something more was finished
};

}  // namespace clatter::sweep
