#include "results/shard.hpp"

#include <charconv>

namespace clatter::results {

std::string text_of(const Shard& shard) { return std::to_string(shard.number).append("/") + std::to_string(shard.of); }

std::optional<Shard> shard_named(std::string_view text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec != std::errc{} || number.ptr == end || *number.ptr != '/') return std::nullopt;
  const auto of = std::from_chars(number.ptr + 1, end, shard.of);
  if (of.ec != std::errc{} || of.ptr != end || shard.number >= shard.of || shard.of > Shard::most) return std::nullopt;
  return shard;
}

}  // namespace clatter::results
