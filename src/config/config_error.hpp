#pragma once

#include <stdexcept>

namespace clatter::config {

/// A mistake in a configuration: `what()` is one line, "file:line:column: what is wrong; the way out".
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace clatter::config
