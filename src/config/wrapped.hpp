#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace clatter::config {

/// The columns of a terminal; no line of help is longer.
inline constexpr std::size_t help_width = 80;

/// Breaks a text that begins behind a margin into lines of at most 80 columns; each line but the first begins with the
/// margin.
[[nodiscard]] std::string wrapped(std::string_view text, std::string_view margin);

/// Breaks a text into lines behind a margin of blanks.
[[nodiscard]] inline std::string wrapped(std::string_view text, std::size_t indent) {
  return wrapped(text, std::string(indent, ' '));
}

}  // namespace clatter::config
