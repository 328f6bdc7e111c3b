#pragma once

#include <stdexcept>
#include <string>

#include "storage/utf8.hpp"

namespace clatter::config {

/// A mistake in a configuration: `what()` is one line, "file:line:column: what is wrong; how to fix it".
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The location of a key or value: in a file, or on the command line.
struct SourceLocation {
  std::string source;  ///< the name of the file as given, or e.g. "--set scene.R=2"
  int line = 0;        ///< from 1; 0 on the command line
  int column = 0;      ///< from 1, in characters, not bytes

  [[nodiscard]] bool operator==(const SourceLocation&) const = default;
};

/// Whether it was given by --set.
[[nodiscard]] inline bool on_command_line(const SourceLocation& location) { return location.line == 0; }

/// "fig22.toml:7:6", or the words of the command line.
[[nodiscard]] inline std::string to_string(const SourceLocation& location) {
  if (on_command_line(location)) return location.source;
  return location.source + ':' + std::to_string(location.line) + ':' + std::to_string(location.column);
}

/// Throws the ConfigError of a mistake at a location.
[[noreturn]] inline void fail(const SourceLocation& location, const std::string& message) {
  throw ConfigError(storage::printable(to_string(location) + ": " + message));
}

}  // namespace clatter::config
