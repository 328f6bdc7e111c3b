#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clatter::results {

/// One of several runs that share a sweep: it has the chains `number`, `number + of`, … of it.
struct Shard {
  static constexpr std::size_t most = 1'000'000;
  std::size_t number = 0, of = 1;  ///< number < of <= most

  bool operator==(const Shard&) const = default;
};

/// A shard as "K/N", from 0/N to N-1/N; empty if a text isn't one.
[[nodiscard]] std::string text_of(const Shard& shard);
[[nodiscard]] std::optional<Shard> shard_named(std::string_view text);

}  // namespace clatter::results
