#pragma once

#include <optional>

#include "sweep/share.hpp"

namespace clatter {

/// Throws IoError where a run's results don't fit into memory: too late to find out at its end.
void check_memory(const Sweep& sweep, const std::optional<Shard>& shard);

}  // namespace clatter
