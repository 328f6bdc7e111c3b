#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace clatter::sweep {

/// A limit of the system within which nothing can run; `what()` is the limit, what is needed, and the way out (exit
/// code 74).
class LimitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes of stack that each thread must have: four times what the deepest calls have been seen to take.
inline constexpr std::size_t needed_stack = std::size_t{512} << 10U;

/// Why the stack of the main thread, which has what `ulimit -s` permits, is too small, and the way out; empty if it
/// suffices. No exception, which would need more of it than there may be.
[[nodiscard]] std::string fault_of_main_stack();

/// Throws LimitError where the threads that a run starts have too little: the first deep call would end the process.
void require_thread_stacks(int threads);

}  // namespace clatter::sweep
