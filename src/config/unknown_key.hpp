#pragma once

#include <string>
#include <string_view>

#include "config/parsed_config.hpp"

namespace clatter::config {

/// The way out of a key that its section doesn't know, for a message: the section in which it belongs, our name of the
/// field's quantity, the nearest name, or all names. `scene_section` is the section that describes the scene.
[[nodiscard]] std::string way_out_of_unknown_key(const ParsedEntry& entry, std::string_view scene_section);

/// The section in words, for a message: "in [scene]", "before the first section".
[[nodiscard]] std::string shown(std::string_view section);

}  // namespace clatter::config
