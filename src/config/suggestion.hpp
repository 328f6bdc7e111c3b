#pragma once

#include <span>
#include <string>
#include <string_view>

namespace clatter::config {

/// Quotes a text for a one-line message: in single quotes, made printable, cut after 60 bytes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The name that the written word abbreviates, else the nearest one by edit distance; empty if none is near.
[[nodiscard]] std::string_view nearest(std::string_view written, std::span<const std::string_view> names);

/// "; did you mean 'nu'?" if a name is near, else all names after `otherwise`, e.g. "; expected one of h, f, nu".
[[nodiscard]] std::string suggestion(std::string_view written, std::span<const std::string_view> names,
                                     std::string_view otherwise);

/// "h, f, nu"
[[nodiscard]] std::string joined(std::span<const std::string_view> names);

}  // namespace clatter::config
