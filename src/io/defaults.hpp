#pragma once

#include <string>

namespace clatter {

enum class Format { toml, ini };

/// A complete commented configuration that runs: every key with its default, its meaning and what it permits.
[[nodiscard]] std::string default_config(Format format);

/// The reference of the configuration as plain text: `clatter help configuration`, and the README's.
[[nodiscard]] std::string configuration_reference();

}  // namespace clatter
