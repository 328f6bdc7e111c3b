#pragma once

#include <string>
#include <string_view>

namespace clatter::results {

/// The SHA-256 digest of a text in hexadecimal, by which two files can be seen to come from the same configuration.
[[nodiscard]] std::string sha256(std::string_view text);

}  // namespace clatter::results
