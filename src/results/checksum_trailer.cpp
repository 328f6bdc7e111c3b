#include "results/checksum_trailer.hpp"

#include <nettle/sha2.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

#include "storage/crc32.hpp"
#include "storage/input_file.hpp"

namespace clatter::results {
namespace {

/// Reads a whole file, piece by piece.
class FilePieces {
 public:
  explicit FilePieces(const std::string& path)
      : path_(path), file_(storage::open_input(path, shards_of_clatter).file) {}

  /// The next bytes, as many as there are; none at the end.
  std::span<const std::byte> next() {
    const ssize_t got = storage::uninterrupted([&] { return ::read(file_.number(), buffer_.data(), buffer_.size()); });
    if (got < 0) storage::refuse_reading(path_, std::strerror(errno), "name a shard's output that can be read");
    return std::span(buffer_).first(static_cast<std::size_t>(got));
  }

 private:
  const std::string& path_;
  storage::Descriptor file_;
  std::vector<std::byte> buffer_ = std::vector<std::byte>(std::size_t{1} << 18);
};

}  // namespace

/// Always of the same length, so that a reader finds its beginning.
std::string checksum_trailer_of(std::uint64_t length, std::uint32_t crc) {
  std::array<char, 64> line{};
  std::snprintf(line.data(), line.size(), "\nclatter shard of %20llu bytes, CRC-32 %08x\n",
                static_cast<unsigned long long>(length), crc);
  return line.data();
}

void add_checksum(storage::FileWriter& file, std::uint64_t length) {
  std::vector<std::byte> piece(std::size_t{1} << 18);
  std::uint32_t crc = 0;
  for (std::uint64_t at = 0; at < length; at += piece.size()) {
    const auto read = std::span(piece).first(std::min<std::uint64_t>(piece.size(), length - at));
    file.read(at, read);
    crc = storage::crc32_of(read, crc);
  }
  const std::string trailer = checksum_trailer_of(length, crc);
  file.write(length, std::as_bytes(std::span(trailer)));
}

void require_checksum(const std::string& path) {
  const std::size_t trailer_length = checksum_trailer_of(0, 0).size();
  FilePieces pieces(path);
  std::uint64_t length = 0;
  std::uint32_t crc = 0;
  std::vector<std::byte> held;  // may end with the trailer
  for (auto piece = pieces.next(); !piece.empty(); piece = pieces.next()) {
    held.insert(held.end(), piece.begin(), piece.end());
    if (held.size() <= trailer_length) continue;
    const auto content = std::span(held).first(held.size() - trailer_length);
    crc = storage::crc32_of(content, crc), length += content.size();
    held.erase(held.begin(), held.end() - static_cast<std::ptrdiff_t>(trailer_length));
  }
  const std::string_view found(reinterpret_cast<const char*>(held.data()), held.size());
  if (found == checksum_trailer_of(length, crc)) return;
  if (found.starts_with("\nclatter shard of "))
    storage::refuse_reading(path, "is damaged (length or CRC-32 of the file)", "copy it again, or run its shard again");
  storage::refuse_reading(path, "is not a complete shard of a sweep",
                          std::string("name ").append(shards_of_clatter).append(", or copy it again"));
}

std::string sha256(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, bytes.size(), bytes.data());
  sha256_digest(&context, digest.size(), digest.data());
  std::string hex;
  for (const std::uint8_t byte : digest) hex += {digits[byte / 16U], digits[byte % 16U]};
  return hex;
}

}  // namespace clatter::results
