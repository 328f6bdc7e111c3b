#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "io/journal.hpp"

namespace clatter {

/// Saves a run's finished points once a second, and where the run has to stop, on SIGINT, SIGTERM or at the end of its
/// time, ends the process after it: with 130, 143, 124; with 74 where they can't be saved. A second signal ends it at
/// once.
class Keeper {
 public:
  using Seconds = std::chrono::duration<double>;

  /// `save` writes what was finished since the last time into the journal. Stops the run after `longest`, if that is
  /// given. There may be one keeper at a time.
  Keeper(Journal& journal, std::function<void()> save, std::optional<Seconds> longest);
  /// The run is over: signals act as by default again.
  ~Keeper();
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  void keep();
  [[nodiscard]] char wait() const;
  [[noreturn]] void leave(int code, const std::string& why);

  Journal& journal_;
  std::function<void()> save_;
  std::optional<Clock::time_point> end_;
  int ends_[2];  ///< of a pipe: signals and the end of the run go into the second
  std::thread thread_;
};

}  // namespace clatter
