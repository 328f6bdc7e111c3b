#pragma once

#include <string>
#include <string_view>

#include "config/config.hpp"
#include "config/settings.hpp"

namespace clatter::config {

/// The complete configuration as TOML: every key that has a value, with defaults filled in; of alternatives only the
/// given ones.
[[nodiscard]] std::string config_text(const Settings& settings);

/// The value of a setting as TOML.
[[nodiscard]] std::string toml_value(const Setting& setting);

/// A TOML text in quotes.
[[nodiscard]] std::string toml_text(std::string_view text);

/// A complete commented configuration that runs: every key with its default, meaning and range.
[[nodiscard]] std::string default_config(Format format);

}  // namespace clatter::config
