#include "printable.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>

namespace verify {
namespace {

struct Range {
  std::uint32_t first, last;
};

/// Control characters, and those that have no picture of their own: marks of direction, joiners, tags, what isn't
/// assigned to text.
constexpr std::array hidden{Range{0x0, 0x1F},      Range{0x7F, 0x9F},       Range{0xAD, 0xAD},
                            Range{0x61C, 0x61C},   Range{0x180E, 0x180E},   Range{0x200B, 0x200F},
                            Range{0x2028, 0x202E}, Range{0x2060, 0x206F},   Range{0xD800, 0xF8FF},
                            Range{0xFE00, 0xFE0F}, Range{0xFEFF, 0xFEFF},   Range{0xFFF0, 0xFFFB},
                            Range{0xFFFE, 0xFFFF}, Range{0x1D173, 0x1D17A}, Range{0xE0000, 0x10FFFF}};

struct Character {
  std::uint32_t code;
  std::size_t bytes;
};

/// The character of UTF-8 that begins at a place; nothing if none does.
std::optional<Character> character_at(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80) return Character{first, 1};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + bytes > text.size()) return std::nullopt;
  std::uint32_t code = first & (0xFFu >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return std::nullopt;
    code = code << 6u | (byte(at + i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10FFFF) return std::nullopt;
  return Character{code, bytes};
}

std::string number(const char* format, unsigned value) {
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace

std::string printable(const std::string& text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const auto character = character_at(text, at);
    if (!character) {
      shown += number("\\x%02X", static_cast<unsigned char>(text[at++]));
      continue;
    }
    const bool hides = std::ranges::any_of(
        hidden, [&](const Range& range) { return character->code >= range.first && character->code <= range.last; });
    shown += hides ? number("\\u{%04X}", character->code) : text.substr(at, character->bytes);
    at += character->bytes;
  }
  return shown;
}

}  // namespace verify
