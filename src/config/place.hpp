#pragma once

#include <string>

#include "config/config.hpp"
#include "storage/utf8.hpp"

namespace clatter {

/// Where a key or a value stands: in a file, or on the command line.
struct Place {
  std::string source;  ///< the file's name as it was given, or e.g. "--set scene.R=2"
  int line = 0;        ///< from 1; 0 on the command line
  int column = 0;      ///< from 1, in characters, not bytes
};

/// Whether it stands behind --set.
[[nodiscard]] inline bool on_command_line(const Place& place) { return place.line == 0; }

/// "fig22.toml:7:6", or the command line's words.
[[nodiscard]] inline std::string to_string(const Place& place) {
  if (on_command_line(place)) return place.source;
  return place.source + ':' + std::to_string(place.line) + ':' + std::to_string(place.column);
}

/// Ends the reading with a mistake of the user's at a place.
[[noreturn]] inline void fail(const Place& place, const std::string& message) {
  throw ConfigError(printable(to_string(place) + ": " + message));
}

}  // namespace clatter
