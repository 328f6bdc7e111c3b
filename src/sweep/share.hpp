#pragma once

#include <bit>
#include <cstddef>
#include <optional>

#include "results/shard.hpp"
#include "sweep/chains.hpp"

namespace clatter::sweep {

/// The chains and points of a sweep that one run has: all, or those of a shard.
class Share {
 public:
  explicit Share(const Sweep& sweep, const std::optional<results::Shard>& shard = {})
      : chains_(sweep), shard_(shard.value_or(results::Shard{})), count_(before(chains_.count)) {}

  [[nodiscard]] std::size_t count() const { return count_; }           ///< chains
  [[nodiscard]] std::size_t length() const { return chains_.length; }  ///< points of a chain
  [[nodiscard]] std::size_t points() const { return count_ * chains_.length; }

  /// Number of points of this run with a smaller index in the sweep than `point`, which may be the number of points.
  [[nodiscard]] std::size_t points_before(std::size_t point) const {
    const std::size_t one_way = chains_.count * chains_.values, rest = point % one_way;
    const std::size_t of_value = rest % (chains_.values * chains_.stride), block = (rest - of_value) / chains_.values;
    const Row row = row_of(block, of_value / chains_.stride);
    return point / one_way * count_ * chains_.values + row.begin + before(block + of_value % chains_.stride) -
           row.first;
  }
  /// Index in the sweep of the point that has so many of this run before it.
  [[nodiscard]] std::size_t point_at(std::size_t local_index) const {
    if (chains_.length == 1) return shard_.number + local_index * shard_.of;
    const std::size_t one_way = count_ * chains_.values, rest = local_index % one_way;
    std::size_t block = 0;  // the last one that doesn't begin beyond it
    for (std::size_t step = std::bit_floor(chains_.count / chains_.stride); step > 0; step /= 2) {
      const std::size_t next = block + step * chains_.stride;
      if (next < chains_.count && before(next) * chains_.values <= rest) block = next;
    }
    const std::size_t beside = row_of(block, 0).length, within = rest - before(block) * chains_.values;
    const std::size_t chain = shard_.number + (before(block) + within % beside) * shard_.of;
    const std::size_t way = local_index / one_way * chains_.count * chains_.values;
    return way + block * chains_.values + within / beside * chains_.stride + chain % chains_.stride;
  }

  /// Index in the sweep of the i-th point of the run's own n-th chain.
  [[nodiscard]] std::size_t point(std::size_t n, std::size_t i) const {
    const std::size_t chain = shard_.number + n * shard_.of;
    return chains_.length == 1 ? chain : chains_.point(chain, i);
  }
  /// Number of points of this run with a smaller index in the sweep. If each chain is one point, that is n.
  [[nodiscard]] std::size_t local_index(std::size_t n, std::size_t i) const {
    if (chains_.length == 1) return n;
    const std::size_t block = (shard_.number + n * shard_.of) / chains_.stride * chains_.stride;
    const Row row = row_of(block, chains_.value(i));
    return (chains_.returns(i) ? count_ * chains_.values : 0) + row.begin + (n - row.first);
  }

 private:
  /// The points of neighbouring chains at one value of the followed dimension.
  struct Row {
    std::size_t begin, length;  ///< local indices on the way out
    std::size_t first;          ///< number of the first chain in this run
  };
  /// `block` is the first of the sweep's chains that lie between each other's points.
  [[nodiscard]] Row row_of(std::size_t block, std::size_t value) const {
    const std::size_t first = before(block), beside = before(block + chains_.stride) - first;
    return {first * chains_.values + value * beside, beside, first};
  }

  /// Number of the run's chains before this chain of the sweep.
  [[nodiscard]] std::size_t before(std::size_t chain) const {
    return chain <= shard_.number ? 0 : (chain - shard_.number - 1) / shard_.of + 1;
  }

  Chains chains_;
  results::Shard shard_;
  std::size_t count_;
};

}  // namespace clatter::sweep
