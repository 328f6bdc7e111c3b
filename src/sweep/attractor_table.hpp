#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "attractors/numbering.hpp"
#include "results/dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Where the points of a run ended.
struct PointEndings {
  std::size_t count = 0;                                               ///< of results
  std::function<std::optional<std::size_t>(std::size_t point)> index;  ///< of a point of the sweep; nothing: not run
  std::function<attractors::Ending(std::size_t index)> ending;
};

/// Numbers the motions that the points of a sweep end in. Ensembles are the points that differ only in x0, v0, phase,
/// start_period, the start of a loose mass and the direction of `follow`. Throws std::bad_alloc.
[[nodiscard]] attractors::Numbering numbering_of(const Sweep& sweep, int threads, const PointEndings& endings);

/// Number of ensembles of a sweep.
[[nodiscard]] std::size_t ensembles_of(const Sweep& sweep);

/// Adds the numbers of the points, over the dimensions `along`, and the table of the motions; unless the points are
/// those of a shard, also how many motions each ensemble has, and their shares of its starts.
void add_attractors(const Sweep& sweep, bool is_shard, const std::vector<std::string>& along,
                    attractors::Numbering numbering, results::Dataset& dataset);

/// Upper bound of the values of one point in these variables.
inline constexpr double attractor_values = 18;

}  // namespace clatter::sweep
