#pragma once

#include <optional>
#include <string>

#include "sweep/share.hpp"

namespace clatter::plan {

/// About how many impacts a point may take at stops that lose nothing (R = 1), max_impacts at most: on a stop that the
/// force presses the mass onto, those of a bouncing that damping makes ever lower; between two such stops the distance
/// travelled over the distance between them; of a loose mass those on a wall that its load presses it onto. 0
/// otherwise.
[[nodiscard]] double impacts_without_loss(const point::Problem& scene);

/// A warning, with the remedy, before a run in which a single point may take long for that reason, or since its
/// transient has a great many periods; nothing if none does. In a large sweep or shard, ten thousand points are
/// examined.
[[nodiscard]] std::optional<std::string> warning_of_costliest_point(const sweep::Sweep& sweep,
                                                                    const std::optional<results::Shard>& shard = {});

}  // namespace clatter::plan
