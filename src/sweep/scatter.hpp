#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <optional>

namespace clatter::sweep {

/// The numbers below `count`, each once, in scattered order. Slow points often lie together; so any first part of the
/// order has its share of them, and its time tells that of the rest.
class Scatter {
 public:
  explicit Scatter(std::size_t count) : count_(count), bits_(static_cast<unsigned>(std::bit_width(count))) {}

  /// Number of turns; not all of them have a number.
  [[nodiscard]] std::size_t turns() const { return std::size_t{1} << bits_; }

  /// The number of a turn: multiplying by an odd number and adding a number's upper bits to its lower ones each give
  /// every number of so many bits once.
  [[nodiscard]] std::optional<std::size_t> number(std::size_t turn) const {
    const std::size_t mask = turns() - 1;
    for (const std::size_t odd : {0x9E3779B97F4A7C15U, 0xBF58476D1CE4E5B9U, 0x94D049BB133111EBU})
      turn = turn * odd & mask, turn ^= turn >> (bits_ / 2 + 1);
    return turn < count_ ? std::optional(turn) : std::nullopt;
  }

 private:
  std::size_t count_;
  unsigned bits_;
};

/// Scattered order in slabs: `slab` neighbours are done before those of another slab, so that their results lie
/// together in memory. The slabs come in scattered order, and so do the numbers of each.
class ScatterInSlabs {
 public:
  ScatterInSlabs(std::size_t count, std::size_t slab)
      : count_(count),
        slab_(std::clamp<std::size_t>(slab, 1, std::max<std::size_t>(count, 1))),
        slabs_((count + slab_ - 1) / slab_),
        within_(slab_) {}

  [[nodiscard]] std::size_t turns() const { return slabs_.turns() * within_.turns(); }

  [[nodiscard]] std::optional<std::size_t> number(std::size_t turn) const {
    const auto slab = slabs_.number(turn / within_.turns()), within = within_.number(turn % within_.turns());
    if (!slab || !within || *slab * slab_ + *within >= count_) return std::nullopt;
    return *slab * slab_ + *within;
  }

 private:
  std::size_t count_, slab_;
  Scatter slabs_, within_;
};

}  // namespace clatter::sweep
