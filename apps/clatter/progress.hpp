#pragma once

#include <chrono>
#include <cstddef>

namespace clatter {

/// A bar on stderr with points, or what else is counted, per second and the time left; it erases itself at its end.
class Progress {
 public:
  /// `before`: what was finished at the beginning, which tells nothing of the speed.
  explicit Progress(bool shown, const char* counted = "points", std::size_t before = 0);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void show(std::size_t finished, std::size_t total) const;

 private:
  bool shown_;
  const char* counted_;
  std::size_t before_;
  bool color_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Whether stderr is a terminal.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace clatter
