#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "sweep/time_left.hpp"

namespace clatter::app {

/// A progress bar on stderr: points (or other units) per second and the time left; it erases itself at the end.
class Progress {
 public:
  /// `before` units are finished at the beginning and don't count for the speed.
  explicit Progress(bool shown, const char* counted = "points", double before = 0);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Shows that `finished` of `total` units are done, fractions included; any thread may call it.
  void show(double finished, double total);
  /// The same if the caller knows how many seconds the rest takes.
  void show(double finished, double total, std::optional<double> seconds_left);

 private:
  void tick();
  void draw() const;
  [[nodiscard]] double now() const;
  [[nodiscard]] std::optional<double> seconds_left() const;

  bool shown_;
  const char* counted_;
  double before_;
  bool color_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();

  std::mutex mutex_;  ///< guards all members below
  double finished_, total_ = 0;
  sweep::TimeLeft pace_;
  bool is_told_ = false;
  std::optional<double> told_end_{};  ///< the end by the caller's estimate
  bool over_ = false;
  std::condition_variable wake_;
  std::thread ticker_;
};

/// Whether stderr is a terminal.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace clatter::app
