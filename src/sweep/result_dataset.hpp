#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

#include "attractors/numbering.hpp"
#include "results/dataset.hpp"
#include "results/shard.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Where the values of a run's results come from, in the order of its points.
struct ResultValues {
  /// Gives those of a variable, by its name.
  std::function<results::NextValues(std::string_view variable)> of;
  std::size_t logged = 0;  ///< impacts in the log of all points
  std::size_t at_once = results::made_at_once;
};

/// The dataset over the sweep's axes, or over the points of a shard, with its coordinates; `numbering` has the motions
/// that the points end in, if attractors are observed. Its values are made while it is written.
[[nodiscard]] results::Dataset result_dataset(const Sweep& sweep, const std::optional<results::Shard>& shard,
                                              const ResultValues& values,
                                              std::optional<attractors::Numbering> numbering);

/// The variables of such a sweep without results: names, dimensions, meanings. There is one motion if attractors are
/// numbered.
[[nodiscard]] results::Dataset description(const Sweep& sweep);

}  // namespace clatter::sweep
