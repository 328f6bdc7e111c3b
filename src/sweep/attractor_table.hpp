#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "attractors/numbering.hpp"
#include "results/dataset.hpp"
#include "results/shard.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Numbers the motions that the points of a sweep, or of a shard, end in, by their intermediate outputs; nothing if
/// attractors aren't observed. `numbers_of` gives an output's values by local index (`Share`). Ensembles are the points
/// that differ only in x0, v0, phase, start_period, the start of a loose mass and the direction of `follow`. Throws
/// std::bad_alloc.
[[nodiscard]] std::optional<attractors::Numbering> numbering_by(
    const Sweep& sweep, const std::optional<results::Shard>& shard, int threads,
    const std::function<std::span<const double>(std::string_view output)>& numbers_of);

/// Number of ensembles of a sweep.
[[nodiscard]] std::size_t ensembles_of(const Sweep& sweep);

/// Adds the numbers of the points, over the dimensions `along`, and the table of the motions; unless the points are
/// those of a shard, also how many motions each ensemble has, and their shares of its starts.
void add_attractors(const Sweep& sweep, bool is_shard, const std::vector<std::string>& along,
                    attractors::Numbering numbering, results::Dataset& dataset);

/// Upper bound of the values of one point in these variables.
inline constexpr double attractor_values = 18;

}  // namespace clatter::sweep
