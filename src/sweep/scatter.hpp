#pragma once

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

}  // namespace clatter::sweep
