#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace clatter::storage {

/// A child process that did not come to its end; `what()` is the reason.
class ChildFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a child process may take: lower limits of the user's stay.
struct ChildLimits {
  std::uint64_t memory = std::uint64_t{2} << 30U;  ///< bytes, beyond what this process has
  std::uint64_t seconds = 30;                      ///< of processor time
  std::uint64_t wall_seconds = 120;                ///< until it has to answer
};

/// What suffices to read a file, several times over: by the room that it takes on its disk, since a length is easily
/// claimed.
[[nodiscard]] ChildLimits limits_for(std::uint64_t stored_bytes);

/// Runs `work` in a child process and gives what it returns: HDF5 1.10 crashes on some damaged files, reads others for
/// ever, and takes all memory for others, which none of its callers can prevent. Takes about a millisecond.
///
/// Throws GuardedDeath where the child crashes or reaches a limit, IoError where there cannot be a child. Passes on an
/// IoError of `work`; what else it throws, but for lack of memory, is a bug and becomes a std::logic_error.
[[nodiscard]] std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace clatter::storage
