#pragma once

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

  /// Index in the sweep of the i-th point of the run's own n-th chain.
  [[nodiscard]] std::size_t point(std::size_t n, std::size_t i) const {
    return chains_.point(shard_.number + n * shard_.of, i);
  }
  /// Number of points of this run with a smaller index in the sweep. If each chain is one point, that is n.
  [[nodiscard]] std::size_t local_index(std::size_t n, std::size_t i) const {
    const std::size_t block = (shard_.number + n * shard_.of) / chains_.stride * chains_.stride;
    const std::size_t first = before(block), beside = before(block + chains_.stride) - first;
    const std::size_t way = chains_.returns(i) ? count_ * chains_.values : 0;
    return way + first * chains_.values + chains_.value(i) * beside + (n - first);
  }

 private:
  /// Number of the run's chains before this chain of the sweep.
  [[nodiscard]] std::size_t before(std::size_t chain) const {
    return chain <= shard_.number ? 0 : (chain - shard_.number - 1) / shard_.of + 1;
  }

  Chains chains_;
  results::Shard shard_;
  std::size_t count_;
};

}  // namespace clatter::sweep
