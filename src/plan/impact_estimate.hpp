#pragma once

#include <optional>

#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::plan {

/// An estimate of the impacts in the log of a sweep or a shard, from short runs of a few of its points.
[[nodiscard]] double expected_impacts(const sweep::Sweep& sweep, const std::optional<sweep::Shard>& shard);

}  // namespace clatter::plan
