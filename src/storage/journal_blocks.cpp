#include "storage/journal_blocks.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "storage/crc32.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"

namespace clatter::storage {
namespace {

/// The bytes of a head that its own checksum covers.
std::span<const std::byte> summed(const BlockHead& head) {
  return std::as_bytes(std::span(&head, 1)).first(offsetof(BlockHead, check));
}

}  // namespace

void append_bytes(Bytes& to, std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

BlockHead head_of(std::span<const std::byte> block) {
  BlockHead head{block.size(), crc32_of(block), 0};
  head.check = crc32_of(summed(head));
  return head;
}

void append_block(Bytes& to, std::span<const std::byte> block) {
  append_number(to, head_of(block));
  append_bytes(to, block);
}

void BlockReader::read(std::span<std::byte> to) {
  while (!to.empty()) {
    if (buffered_.empty()) fill();
    const std::size_t some = std::min(to.size(), buffered_.size());
    std::ranges::copy(buffered_.first(some), to.begin());
    to = to.subspan(some), buffered_ = buffered_.subspan(some), at_ += some;
  }
}

std::optional<BlockHead> BlockReader::head(double most_bytes) {
  const std::uint64_t begin = at_;
  BlockHead head{};
  if (left() < sizeof head) return std::nullopt;
  read(std::as_writable_bytes(std::span(&head, 1)));
  if (head.length == 0 && head.crc == 0 && head.check == 0 && only_zeros_left()) return std::nullopt;
  if (crc32_of(summed(head)) != head.check || static_cast<double>(head.length) > most_bytes) damaged(begin);
  return head.length > left() ? std::nullopt : std::optional(head);
}

std::optional<std::span<const std::byte>> BlockReader::block(double most_bytes) {
  const std::uint64_t begin = at_;
  const std::optional<BlockHead> next = head(most_bytes);
  if (!next) return std::nullopt;
  block_.resize(static_cast<std::size_t>(next->length));
  read(block_);
  if (crc32_of(block_) != next->crc) {
    if (left() == 0 && !block_.empty() && block_.back() == std::byte{}) return std::nullopt;  // a power cut
    damaged(begin);
  }
  return block_;
}

void BlockReader::damaged(std::uint64_t where) const {
  throw IoError(quoted_name(path_.string()) + " is damaged at byte " + std::to_string(where) +
                ", so the finished points in it can't be trusted; --restart begins anew");
}

/// Whether only zeros are left, as a power cut may leave the last records. Skips holes, in which nothing is stored,
/// without reading them.
bool BlockReader::only_zeros_left() {
  while (left() > 0) {
    if (buffered_.empty() && !skip_hole()) return true;
    std::byte next{};
    read(std::span(&next, 1));
    if (next != std::byte{}) return false;
  }
  return true;
}

/// Skips to the next data; false if there are none.
bool BlockReader::skip_hole() {
  const off_t data = ::lseek(file_.number(), static_cast<off_t>(at_), SEEK_DATA);
  if (data >= 0) at_ = static_cast<std::uint64_t>(data);
  return at_ < size_ && (data >= 0 || errno != ENXIO);  // some file systems don't tell
}

void BlockReader::fill() {
  const ssize_t got = uninterrupted([&] { return ::read(file_.number(), buffer_.data(), buffer_.size()); });
  if (got <= 0)
    throw IoError("cannot read " + quoted_name(path_.string()) + ": " +
                  (got < 0 ? std::strerror(errno) : "it became shorter") + "; try again, or begin anew with --restart");
  buffered_ = std::span<const std::byte>(buffer_).first(static_cast<std::size_t>(got));
}

}  // namespace clatter::storage
