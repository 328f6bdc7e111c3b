#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace clatter::storage {

/// A child process that failed to finish; `what()` is the reason.
class ChildFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The limits of a child process; the user's own limits hold too, if they are lower.
struct ChildLimits {
  std::uint64_t memory = std::uint64_t{2} << 30U;  ///< bytes, beyond what this process has
  std::uint64_t seconds = 30;                      ///< of processor time
  std::uint64_t wall_seconds = 120;                ///< time to its answer
};

/// Limits that suffice several times over to read a file, by the space that it takes on its disk: its length could be
/// any number.
[[nodiscard]] ChildLimits limits_for(std::uint64_t stored_bytes);

/// Runs `work` in a child process and returns its result: HDF5 1.10 crashes on some damaged files, reads others for
/// ever, and takes all memory for others, which no caller can prevent. Costs about a millisecond.
///
/// Throws ChildFailed if the child crashes or reaches a limit, IoError if no child can be started. Passes on an IoError
/// of `work`; any other exception of it, but for lack of memory, is a bug and becomes a std::logic_error.
[[nodiscard]] std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace clatter::storage
