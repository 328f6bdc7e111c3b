#pragma once

#include <vector>

#include "config/settings.hpp"

namespace clatter::config {

/// Warns of keys that change nothing with the others, except those at their default, as in a complete text.
[[nodiscard]] std::vector<Warning> keys_without_effect(const Settings& settings);

}  // namespace clatter::config
