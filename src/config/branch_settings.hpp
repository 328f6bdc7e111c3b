#pragma once

#include <optional>

#include "branches/settings.hpp"
#include "config/settings.hpp"

namespace clatter::config {

/// [branch], with ranges in the user's units; nothing if no key of it is given. Throws
/// ConfigError if a key is missing, a value of a range isn't permitted, or [sweep] has an axis of the same key.
[[nodiscard]] std::optional<branches::BranchSettings> branch_settings_of(const Settings& settings);

}  // namespace clatter::config
