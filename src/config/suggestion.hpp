#pragma once

#include <span>
#include <string>
#include <string_view>

namespace clatter::config {

/// A text for a message of one line: in single quotes, as `printable` shows it, cut after 60 bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The name that was abbreviated, else the one nearest to what was written by edit distance; empty where none is near.
[[nodiscard]] std::string_view nearest(std::string_view written, std::span<const std::string_view> names);

/// "; did you mean 'nu'?" where a name is near, else all the names after `otherwise`, e.g. "; permitted: h, f, nu".
[[nodiscard]] std::string suggestion(std::string_view written, std::span<const std::string_view> names,
                                     std::string_view otherwise);

/// "h, f, nu"
[[nodiscard]] std::string joined(std::span<const std::string_view> names);

}  // namespace clatter::config
