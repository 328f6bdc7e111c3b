#pragma once

#include <charconv>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>

namespace verify {

/// The time for a claim is over.
class OutOfTime : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// When a thread gives up its present claim.
class Deadline {
 public:
  /// So many seconds from now on.
  void begin(double seconds) {
    seconds_ = seconds;
    at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
  [[nodiscard]] bool is_over() const { return Clock::now() >= at_; }
  [[noreturn]] void give_up() const {
    char text[32];
    const char* const end = std::to_chars(text, text + sizeof text, seconds_).ptr;
    throw OutOfTime("no verdict within " + std::string(static_cast<const char*>(text), end) +
                    " s; --limit gives it more");
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point at_ = Clock::time_point::max();
  double seconds_ = std::numeric_limits<double>::infinity();
};
inline thread_local Deadline deadline;

/// Called in each loop whose length a certificate decides.
inline void require_time() {
  if (deadline.is_over()) deadline.give_up();
}

}  // namespace verify
