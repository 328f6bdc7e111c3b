#pragma once

#include <optional>

#include "branches/settings.hpp"
#include "config/settings.hpp"

namespace clatter::config {

/// [branch], in the units of the problem that the branch begins with; nothing if no key of it is given. Throws
/// ConfigError if a key is missing, a value of a range isn't permitted, or [sweep] has an axis of the same key.
[[nodiscard]] std::optional<branches::BranchSettings> branch_settings_of(const Settings& settings,
                                                                         const point::Problem& start);

}  // namespace clatter::config
