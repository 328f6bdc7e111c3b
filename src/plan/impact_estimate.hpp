#pragma once

#include <optional>

#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::plan {

/// Impacts in the log of a sweep, or of a shard: an estimate, from a few of its points, each for a short time.
[[nodiscard]] double expected_impacts(const sweep::Sweep& sweep, const std::optional<sweep::Shard>& shard);

}  // namespace clatter::plan
