#pragma once

#include <vector>

#include "config/settings.hpp"

namespace clatter::config {

/// Keys that change nothing beside the others, but for those that stand on their default, as in a complete text.
[[nodiscard]] std::vector<Warning> keys_without_effect(const Settings& settings);

}  // namespace clatter::config
