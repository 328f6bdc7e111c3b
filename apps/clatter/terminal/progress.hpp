#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "sweep/time_left.hpp"

namespace clatter::app {

/// Progress as a bar that fits the terminal, or, elsewhere, as lines of work that takes long.
enum class ProgressKind : std::uint8_t { none, bar, lines };

/// Shows on stderr how many points (or other units) are finished, and the time left. A bar erases itself at the end; a
/// line is printed once it is known that the rest takes half a minute or more, and each minute from then on.
class Progress {
 public:
  /// `before` units are finished at the beginning and don't count for the speed.
  explicit Progress(ProgressKind kind, const char* counted = "points", double before = 0);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Shows that `finished` of `total` units are done, fractions included; any thread may call it.
  void show(double finished, double total);
  /// Shows it with the seconds that the rest takes, if the caller knows them.
  void show(double finished, double total, std::optional<double> seconds_left);

 private:
  void tick();
  void draw();
  void print_line();
  [[nodiscard]] std::string bar(std::size_t columns) const;
  [[nodiscard]] double now() const;
  [[nodiscard]] std::optional<double> seconds_left() const;

  ProgressKind kind_;
  const char* counted_;
  double before_;
  bool color_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();

  std::mutex mutex_;  ///< guards all members below
  double finished_, total_ = 0;
  sweep::TimeLeft pace_;
  bool is_told_ = false;
  std::optional<double> told_end_{};   ///< the end by the caller's estimate
  std::optional<double> next_line_{};  ///< the earliest time of the next line; nothing before the first
  bool over_ = false;
  std::condition_variable wake_;
  std::thread ticker_;
};

/// Whether stderr is a terminal.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace clatter::app
