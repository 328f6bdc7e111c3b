#pragma once

#include <cstddef>
#include <stdexcept>

namespace clatter {

/// A limit of the system within which nothing can run; `what()` is the limit, what is needed, and the way out (exit
/// code 74).
class LimitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes of stack that each thread must have: four times what the deepest calls have been seen to take.
inline constexpr std::size_t needed_stack = std::size_t{512} << 10U;

/// Throws LimitError where the stack of the main thread, which has what `ulimit -s` permits, is too small: the first
/// deep call would end the process.
void require_main_stack();

/// The same for the thread that calls it, which has what it was started with.
void require_thread_stack();

}  // namespace clatter
