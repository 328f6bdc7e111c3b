#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <numeric>
#include <vector>

#include "sweep/run.hpp"

namespace clatter::sweep {

/// Calls the user's progress function a few times a second, and for every hundredth of the whole, from one thread at a
/// time.
class SweepProgress {
 public:
  SweepProgress(const RunOptions& options, std::size_t threads, std::size_t total, std::size_t done)
      : report_(options.progress), total_(total), done_(done), reported_(done), parts_(threads, 0.0) {}

  void add_point(std::size_t thread) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    ++done_, parts_[thread] = 0;
    const auto now = Clock::now();
    if (now - last_ <= std::chrono::milliseconds(200) && 100 * (done_ - reported_) < total_ && done_ != total_) return;
    report(now);
  }

  /// The finished share of the points that a thread is working on.
  void add_part(std::size_t thread, double part) {
    const std::lock_guard lock(mutex_);
    parts_[thread] = part;
    if (const auto now = Clock::now(); now - last_ > std::chrono::milliseconds(200)) report(now);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void report(Clock::time_point now) {
    last_ = now, reported_ = done_;
    const double parts = std::accumulate(parts_.begin(), parts_.end(), 0.0);
    report_(std::min(static_cast<double>(done_) + parts, static_cast<double>(total_)), total_);
  }

  const std::function<void(double, std::size_t)>& report_;
  std::mutex mutex_;
  std::size_t total_, done_, reported_;
  std::vector<double> parts_;  ///< [thread]
  Clock::time_point last_{};
};

}  // namespace clatter::sweep
