#include "io/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace clatter {

std::string sha256(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error{"OpenSSL cannot compute a SHA-256 digest"};
  }
  std::string hex;
  for (unsigned i = 0; i < length; ++i) {
    hex += digits[digest[i] / 16U];
    hex += digits[digest[i] % 16U];
  }
  return hex;
}

}  // namespace clatter
