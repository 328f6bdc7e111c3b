#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "storage/journal.hpp"

namespace clatter::app {

/// Saves a run's finished points once a second. When the run has to stop, at SIGINT, SIGTERM, SIGHUP or the end of its
/// time, says so, saves, and ends the process with 130, 143, 129 or 124, or with 74 if saving fails. A second signal
/// ends it at once.
class Checkpointer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `save` writes the points finished since the last call into the journal. Stops the run at `end`, if given. Only one
  /// Checkpointer may exist at a time. Throws IoError if no pipe or thread can be made.
  Checkpointer(storage::Journal& journal, std::function<void()> save, std::optional<Clock::time_point> end);
  /// If `finish` wasn't called, the run has failed: saves what it can.
  ~Checkpointer();
  Checkpointer(const Checkpointer&) = delete;
  Checkpointer& operator=(const Checkpointer&) = delete;

  /// Call when all points are done, before writing the output. Saves the journal once more if the run took over a
  /// second or has saved before, in case the output can't be written; errors are ignored. A first signal is now only
  /// reported; a second ends the process.
  void finish();

 private:
  void keep();
  void save();
  void save_if_possible();
  [[nodiscard]] char wait() const;
  [[noreturn]] void give_up(const char* why);
  [[noreturn]] void stop(int code, const std::string& why);

  storage::Journal& journal_;
  std::function<void()> save_;
  Clock::time_point begin_ = Clock::now();
  std::optional<Clock::time_point> end_;
  std::mutex saving_;
  bool finishing_ = false;
  int ends_[2];  ///< of a pipe: signals and the end of the run are written into the second
  std::thread thread_;
};

}  // namespace clatter::app
