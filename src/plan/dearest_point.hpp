#pragma once

#include <optional>
#include <string>

#include "sweep/share.hpp"

namespace clatter::plan {

/// About how many impacts a point may take where its stops take nothing from the mass (R = 1): up to max_impacts where
/// a force presses it onto such a stop, since it bounces on there, ever lower, without end; between two of them what
/// the distance between them makes of the way that it goes. 0 where there is nothing to be wary of.
[[nodiscard]] double impacts_without_loss(const point::Problem& scene);

/// A sentence for the user before a run in which a single point may take long for that reason, with the remedy; nothing
/// where none does. Of a large sweep, or shard, ten thousand points are looked at.
[[nodiscard]] std::optional<std::string> warning_of_dearest_point(const sweep::Sweep& sweep,
                                                                  const std::optional<sweep::Shard>& shard = {});

}  // namespace clatter::plan
