#include "storage/utf8.hpp"

#include <algorithm>
#include <cstdint>

namespace clatter::storage {
namespace {

std::uint8_t byte(char character) { return static_cast<std::uint8_t>(character); }

bool is_continuation(char character) { return (byte(character) & 0xC0) == 0x80; }

struct Range {
  char32_t first, last;
};

/// Control characters of ASCII and ISO 6429; characters that change the direction of a text or begin a line; those
/// without width, by which a name can look like another one (Unicode, UAX 9, 14 and UTS 39).
constexpr Range obeyed[] = {{0, 0x1F},        {0x7F, 0x9F},     {0xAD, 0xAD},     {0x61C, 0x61C},
                            {0x180E, 0x180E}, {0x200B, 0x200B}, {0x200E, 0x200F}, {0x2028, 0x202E},
                            {0x2060, 0x206F}, {0xFEFF, 0xFEFF}, {0xFFF9, 0xFFFB}, {0xE0000, 0xE007F}};

void append_hexadecimal(std::string& text, std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  for (const char character : bytes) text += {'\\', 'x', digits[byte(character) / 16], digits[byte(character) % 16]};
}

}  // namespace

/// RFC 3629: no overlong forms, no surrogates.
std::size_t utf8_length(std::string_view text) {
  const std::uint8_t lead = byte(text[0]);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  if (!std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), is_continuation)) return 0;
  const std::uint8_t second = byte(text[1]);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool beyond = (lead == 0xED && second >= 0xA0) || (lead == 0xF4 && second >= 0x90);
  return overlong || beyond ? 0 : length;
}

char32_t code_point(std::string_view character) {
  constexpr std::uint8_t masks[] = {0, 0x7F, 0x1F, 0x0F, 0x07};  // of the first byte, by length
  char32_t point = byte(character[0]) & masks[character.size()];
  for (const char next : character.substr(1)) point = point << 6U | (byte(next) & 0x3FU);
  return point;
}

int characters(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char character) { return !is_continuation(character); }));
}

bool is_obeyed(std::string_view character) {
  const char32_t point = code_point(character);
  if (point > 0x1F && point < 0x7F) return false;
  return std::ranges::any_of(obeyed, [&](const Range& range) { return range.first <= point && point <= range.last; });
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    const std::string_view character = text.substr(at, std::max<std::size_t>(length, 1));
    if (length == 0 || is_obeyed(character)) {
      append_hexadecimal(shown, character);
    } else {
      shown += character;
    }
    at += character.size();
  }
  return shown;
}

std::string excerpt(std::string_view text, std::size_t most) {
  std::size_t length = std::min(text.size(), most);
  while (length < text.size() && length > 0 && is_continuation(text[length])) --length;
  return printable(text.substr(0, length)) + (length < text.size() ? "…" : "");
}

std::string quoted_name(std::string_view text) { return '\'' + printable(text) + '\''; }

std::string printable_lines(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    (shown += printable(text.substr(0, end))) += end < text.size() ? "\n" : "";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return shown;
}

std::size_t find_not_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return std::string_view::npos;
}

}  // namespace clatter::storage
