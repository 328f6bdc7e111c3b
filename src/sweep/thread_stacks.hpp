#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace clatter::sweep {

/// A limit of the system that is too narrow for any run; `what()` names the limit, the need and the remedy (exit code
/// 74).
class LimitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes of stack that each thread must have: four times the deepest use that was measured.
inline constexpr std::size_t needed_stack = std::size_t{512} << 10U;

/// Why the stack of the main thread, which has what `ulimit -s` permits, is too small, and how to fix it; empty if it
/// suffices. No exception, which would need more of it than there may be.
[[nodiscard]] std::string fault_of_main_stack();

/// Throws LimitError if the threads that a run starts have less: the first deep call would end the process.
void require_thread_stacks(int threads);

}  // namespace clatter::sweep
