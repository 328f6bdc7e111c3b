#pragma once

#include <optional>
#include <string>

#include "sweep/dataset.hpp"
#include "sweep/share.hpp"

namespace clatter::app {

/// "2 failed (event_budget: 2, e.g. point 0 at nu = 0.5)": how many points of a run failed, how many by each status,
/// and the first of each by its index in the sweep, from 0.
[[nodiscard]] std::string failures_text(const sweep::Dataset& dataset, const sweep::Sweep& sweep,
                                        const std::optional<sweep::Shard>& shard = {});

}  // namespace clatter::app
