#pragma once

#include <string>
#include <string_view>

namespace clatter::config {

/// Throws ConfigError at text that would crash toml++ 3.3: non-ASCII characters outside comments and quotes, and keys
/// of very many parts.
void check_toml(const std::string& file, std::string_view text);

}  // namespace clatter::config
