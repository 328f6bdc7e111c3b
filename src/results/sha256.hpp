#pragma once

#include <string>
#include <string_view>

namespace clatter::results {

/// The SHA-256 digest of a text in hexadecimal, which shows whether two files come from the same configuration.
[[nodiscard]] std::string sha256(std::string_view text);

}  // namespace clatter::results
