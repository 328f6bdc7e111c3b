#pragma once

#include <string>
#include <string_view>

#include "config/keys.hpp"

namespace clatter::config {

/// The reference of the configuration as plain text, printed by `clatter help configuration` and copied into
/// configs/README.md.
[[nodiscard]] std::string configuration_reference();

/// The values that a key permits, and its default: "0 ... 1; default: 1".
[[nodiscard]] std::string permitted_and_default(const Key& key);

/// The axes of [sweep] in words, after "any key of [scene]".
inline constexpr std::string_view axes_help =
    "or [machine]: an axis, one a line; the first varies slowest; every combination of the axes is a point";

/// The keys of one section.
[[nodiscard]] std::string section_reference(std::string_view section);

/// The reference of how values are written.
[[nodiscard]] std::string_view value_reference();

/// The reference of one key, with examples.
[[nodiscard]] std::string key_reference(const Key& key);

/// Lines of TOML in which a key has an effect.
[[nodiscard]] std::string key_example(const Key& key);

/// Lines of TOML in which a key of [scene] is an axis.
[[nodiscard]] std::string axis_example(const Key& key);

}  // namespace clatter::config
