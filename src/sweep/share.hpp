#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "sweep/branches.hpp"

namespace clatter::sweep {

/// One of several runs that share a sweep: it has the branches `number`, `number + of`, … of it.
struct Shard {
  static constexpr std::size_t most = 1'000'000;
  std::size_t number = 0, of = 1;  ///< number < of <= most

  bool operator==(const Shard&) const = default;
};

/// A shard as "K/N", from 0/N to N-1/N; empty if a text isn't one.
[[nodiscard]] std::string text_of(const Shard& shard);
[[nodiscard]] std::optional<Shard> shard_named(std::string_view text);

/// The branches and points of a sweep that one run has: all, or those of a shard.
class Share {
 public:
  explicit Share(const Sweep& sweep, const std::optional<Shard>& shard = {})
      : branches_(sweep), shard_(shard.value_or(Shard{})), count_(before(branches_.count)) {}

  [[nodiscard]] std::size_t count() const { return count_; }             ///< branches
  [[nodiscard]] std::size_t length() const { return branches_.length; }  ///< points of a branch
  [[nodiscard]] std::size_t points() const { return count_ * branches_.length; }

  /// Index in the sweep of the i-th point of the run's own n-th branch.
  [[nodiscard]] std::size_t point(std::size_t n, std::size_t i) const {
    return branches_.point(shard_.number + n * shard_.of, i);
  }
  /// Number of points of this run with a smaller index in the sweep. If each branch is one point, that is n.
  [[nodiscard]] std::size_t local_index(std::size_t n, std::size_t i) const {
    const std::size_t block = (shard_.number + n * shard_.of) / branches_.stride * branches_.stride;
    const std::size_t first = before(block), beside = before(block + branches_.stride) - first;
    const std::size_t way = branches_.returns(i) ? count_ * branches_.values : 0;
    return way + first * branches_.values + branches_.value(i) * beside + (n - first);
  }

 private:
  /// Number of the run's branches before this branch of the sweep.
  [[nodiscard]] std::size_t before(std::size_t branch) const {
    return branch <= shard_.number ? 0 : (branch - shard_.number - 1) / shard_.of + 1;
  }

  Branches branches_;
  Shard shard_;
  std::size_t count_;
};

}  // namespace clatter::sweep
