#include "results/sha256.hpp"

#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <vector>

namespace clatter::results {

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
