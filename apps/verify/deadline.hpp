#pragma once

#include <chrono>
#include <stdexcept>

namespace verify {

/// The time for a claim is over.
class OutOfTime : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// When a thread gives up its present claim.
inline thread_local std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

/// Called in each loop whose length a certificate decides.
inline void require_time() {
  if (std::chrono::steady_clock::now() >= deadline) throw OutOfTime("the time for a claim is over");
}

}  // namespace verify
