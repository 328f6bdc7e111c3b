#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace clatter::support {

/// The checksum of HDF5's metadata: Jenkins' lookup3, hashlittle().
inline std::uint32_t lookup3(std::span<const std::uint8_t> bytes) {
  std::array<std::uint32_t, 3> s{};
  s.fill(0xdeadbeefU + static_cast<std::uint32_t>(bytes.size()));
  auto& [a, b, c] = s;
  const auto add = [&](std::span<const std::uint8_t> some) {
    for (std::size_t i = 0; i < some.size(); ++i) s[i / 4] += std::uint32_t{some[i]} << 8 * (i % 4);
  };
  for (; bytes.size() > 12; bytes = bytes.subspan(12)) {
    add(bytes.first(12));
    a -= c, a ^= std::rotl(c, 4), c += b;
    b -= a, b ^= std::rotl(a, 6), a += c;
    c -= b, c ^= std::rotl(b, 8), b += a;
    a -= c, a ^= std::rotl(c, 16), c += b;
    b -= a, b ^= std::rotl(a, 19), a += c;
    c -= b, c ^= std::rotl(b, 4), b += a;
  }
  if (bytes.empty()) return c;
  add(bytes);
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
  return c;
}

}  // namespace clatter::support
