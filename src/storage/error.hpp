#pragma once

#include <stdexcept>
#include <string>

namespace clatter::storage {

/// A file that cannot be read or written; `what()` names it, the reason and the way out (exit code 74).
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The error of memory that is or would be short, the same wherever that shows.
[[nodiscard]] inline IoError no_memory(const std::string& why) {
  return IoError("not enough memory: " + why +
                 "; sweep fewer points, observe less, share the points out with --shard, or go where there is more");
}

}  // namespace clatter::storage
