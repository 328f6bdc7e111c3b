#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "storage/journal.hpp"

namespace clatter::app {

/// Saves a run's finished points once a second. Where the run has to stop, on SIGINT, SIGTERM, SIGHUP or at the end of
/// its time, says so, saves, and ends the process: with 130, 143, 129, 124; with 74 where they can't be saved. A second
/// signal ends it at once.
class Checkpointer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `save` writes what was finished since the last time into the journal. Stops the run at `end`, if that is given.
  /// There may be one keeper at a time. Throws IoError where there can be no pipe or thread.
  Checkpointer(storage::Journal& journal, std::function<void()> save, std::optional<Clock::time_point> end);
  /// Without `finish` before it, the run has failed: saves what it can.
  ~Checkpointer();
  Checkpointer(const Checkpointer&) = delete;
  Checkpointer& operator=(const Checkpointer&) = delete;

  /// All points are finished. Saves them, where it can and the run was long, should the output find no room; that is
  /// written next, and a first signal doesn't stop it.
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
  int ends_[2];  ///< of a pipe: signals and the end of the run go into the second
  std::thread thread_;
};

}  // namespace clatter::app
