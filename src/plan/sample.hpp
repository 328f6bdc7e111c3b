#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace clatter::plan {

/// Pseudorandom bits that belong to a number, on every machine (the finaliser of SplitMix64).
inline std::uint64_t scrambled(std::uint64_t number) {
  number += 0x9E3779B97F4A7C15U;
  number = (number ^ (number >> 30U)) * 0xBF58476D1CE4E5B9U;
  number = (number ^ (number >> 27U)) * 0x94D049BB133111EBU;
  return number ^ (number >> 31U);
}

/// A sample of the numbers below `count`: one, at a pseudorandom position that follows no axis, of each stretch of
/// equal length (to one number); all of them if there are at most `most`. `most` times `count` must fit into 64 bits.
class Sample {
 public:
  struct Draw {
    std::size_t number = 0;
    std::size_t weight = 1;  ///< length of its stretch: the numbers that it stands for
  };

  Sample(std::size_t count, std::size_t most) : count_(count), size_(std::min(count, most)) {}

  [[nodiscard]] std::size_t size() const { return size_; }

  /// The i-th number of the sample, in ascending order.
  [[nodiscard]] Draw operator[](std::size_t i) const {
    const std::size_t first = i * count_ / size_, weight = (i + 1) * count_ / size_ - first;
    return {first + scrambled(i) % weight, weight};
  }

 private:
  std::size_t count_, size_;
};

}  // namespace clatter::plan
