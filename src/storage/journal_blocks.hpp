#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "storage/file_calls.hpp"

namespace clatter::storage {

using Bytes = std::vector<std::byte>;

void append_bytes(Bytes& to, std::span<const std::byte> bytes);

template <class Number>
void append_number(Bytes& to, Number number) {
  append_bytes(to, std::as_bytes(std::span(&number, 1)));
}

/// The head of a block of bytes in a journal.
struct BlockHead {
  std::uint64_t length;
  std::uint32_t crc;
  std::uint32_t check;  ///< CRC-32 of length and crc, so that a damaged length isn't taken for an incomplete end
};

[[nodiscard]] BlockHead head_of(std::span<const std::byte> block);

void append_block(Bytes& to, std::span<const std::byte> block);

/// Reads a journal from its beginning. Throws IoError.
class BlockReader {
 public:
  /// Reads a file of `size` bytes; errors name `path`.
  BlockReader(const Descriptor& file, std::uint64_t size, const std::filesystem::path& path)
      : file_(file), size_(size), path_(path) {}

  [[nodiscard]] std::uint64_t at() const { return at_; }
  [[nodiscard]] std::uint64_t left() const { return size_ - at_; }

  void read(std::span<std::byte> to);

  /// The head of the next block; nothing if the block is incomplete. Throws IoError if the head is damaged, or the
  /// block is longer than `most_bytes`.
  [[nodiscard]] std::optional<BlockHead> head(double most_bytes);

  /// The next block, under the same conditions as `head`.
  [[nodiscard]] std::optional<std::span<const std::byte>> block(double most_bytes);

  /// Throws the error of damage at byte `where`.
  [[noreturn]] void damaged(std::uint64_t where) const;

 private:
  bool only_zeros_left();
  bool skip_hole();
  void fill();

  const Descriptor& file_;
  std::uint64_t size_, at_ = 0;
  const std::filesystem::path& path_;
  Bytes buffer_ = Bytes(std::size_t{1} << 18), block_;
  std::span<const std::byte> buffered_;
};

}  // namespace clatter::storage
