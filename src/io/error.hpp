#pragma once

#include <stdexcept>

namespace clatter {

/// A file that cannot be read or written; `what()` names it, the reason and the way out (exit code 74).
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace clatter
