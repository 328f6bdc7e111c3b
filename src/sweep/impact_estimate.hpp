#pragma once

#include <optional>

#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter {

/// Impacts in the log of a sweep, or of a shard: an estimate, from a few of its points, each for a short time.
[[nodiscard]] double expected_impacts(const Sweep& sweep, const std::optional<Shard>& shard);

}  // namespace clatter
