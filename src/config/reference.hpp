#pragma once

#include <string>
#include <string_view>

#include "config/keys.hpp"

namespace clatter::config {

/// The reference of the configuration as plain text: `clatter help configuration`, and the README's.
[[nodiscard]] std::string configuration_reference();

/// The keys of one section.
[[nodiscard]] std::string section_reference(std::string_view section);

/// How values are written.
[[nodiscard]] std::string_view value_reference();

/// One key with examples.
[[nodiscard]] std::string key_reference(const Key& key);

/// Lines of TOML in which a key has an effect.
[[nodiscard]] std::string key_example(const Key& key);

/// Lines of TOML in which a key of [scene] is an axis.
[[nodiscard]] std::string axis_example(const Key& key);

}  // namespace clatter::config
