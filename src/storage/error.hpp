#pragma once

#include <stdexcept>
#include <string>

namespace clatter::storage {

/// A file that cannot be read or written; `what()` names it, the reason and the remedy (exit code 74).
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The error of memory that is or would be short, in the same words everywhere.
[[nodiscard]] inline IoError no_memory(const std::string& why) {
  return IoError("not enough memory: " + why +
                 "; sweep fewer points, observe less, divide the sweep with --shard, or use a machine that has more");
}

}  // namespace clatter::storage
