#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace clatter::config {

/// The columns of a terminal; every help page keeps within them.
inline constexpr std::size_t help_width = 80;

/// The text, which begins behind a margin, in lines that end before column 81, each line but the first with the margin
/// before it.
[[nodiscard]] std::string wrapped(std::string_view text, std::string_view margin);

/// The same, the margin of blanks.
[[nodiscard]] inline std::string wrapped(std::string_view text, std::size_t indent) {
  return wrapped(text, std::string(indent, ' '));
}

}  // namespace clatter::config
