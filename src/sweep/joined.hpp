#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "results/shard.hpp"
#include "sweep/status_tally.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Bytes of the values of a variable that are read from the parts before they are passed on.
inline constexpr std::size_t joined_at_once = 16UL << 20U;

/// The results of a shard, which are read part by part; any of these calls may throw.
struct Part {
  results::Shard shard;
  /// The number of rows of a variable, the length of its first dimension; nothing if there is none of this name.
  std::function<std::optional<std::size_t>(const std::string& variable)> rows;
  /// The values of so many of its rows, from `first` on.
  std::function<results::ValueArray(const std::string& variable, std::size_t first, std::size_t rows)> values;
};

/// A part that isn't what a run of its sweep writes; `what()` is the reason.
class PartError : public std::runtime_error {
 public:
  PartError(std::size_t part, const std::string& why) : std::runtime_error(why), part_(part) {}
  [[nodiscard]] std::size_t part() const { return part_; }

 private:
  std::size_t part_;
};

/// The results of a whole sweep.
struct Joined {
  results::Dataset dataset;
  StatusTally statuses;
};

/// Joins the shards that make a sweep: the dataset of a single run, bit for bit. Its values are read while it is
/// written; sweep and parts have to be there meanwhile. Throws PartError, here or then, and std::bad_alloc.
[[nodiscard]] Joined joined(const Sweep& sweep, const std::vector<Part>& parts, int threads);

}  // namespace clatter::sweep
