#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/key.hpp"

namespace clatter::config {

/// The value of a key of several choices if it has none of them.
inline constexpr std::string_view no_choice = "none";

/// Every key, in the order of the configuration's text.
[[nodiscard]] std::span<const Key> keys();

/// The sections in their order, without the top level.
[[nodiscard]] std::span<const std::string_view> sections();

/// Whether it is one of the two sections that describe a scene: [scene] without units, [machine] in SI.
[[nodiscard]] bool describes_scene(std::string_view section);

/// The key of that name, or nullptr; in [sweep] every key that describes a scene is that of an axis, that of [scene] if
/// [machine] has one of the same name.
[[nodiscard]] const Key* find_key(std::string_view section, std::string_view name);

/// The names that a section takes.
[[nodiscard]] std::vector<std::string_view> key_names(std::string_view section);

/// Whether an INI value is free text, in which ';' and '#' begin a comment only after a blank.
[[nodiscard]] bool is_free_text(std::string_view section, std::string_view name);

[[nodiscard]] bool contains(const AllowedRange& range, double value);

/// The values that a key permits, for messages and the help: "> 0", "0 ... 1", "> 0, in kg", "true or false".
[[nodiscard]] std::string permitted(const Key& key);

}  // namespace clatter::config
