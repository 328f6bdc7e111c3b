#include "format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>

#include "storage/utf8.hpp"

namespace clatter::app {

std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string counted(double count, const char* noun) {
  return formatted("%.0f", count) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"bytes", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024 && unit + 1 < units.size(); ++unit) bytes /= 1024;
  return formatted("%.4g", bytes) + ' ' + units[unit];
}

namespace {

/// Appends a character as a JSON escape, by its UTF-16 units.
void append_escape(std::string& text, std::string_view character) {
  if (character == "\"" || character == "\\") {
    (text += '\\') += character;
    return;
  }
  const auto append_unit = [&](char32_t unit) {
    constexpr std::string_view digits = "0123456789abcdef";
    text += "\\u";
    for (const unsigned shift : {12U, 8U, 4U, 0U}) text += digits[unit >> shift & 0xFU];
  };
  const char32_t point = storage::code_point(character);
  if (point > 0xFFFF) append_unit(0xD800 + ((point - 0x10000) >> 10U));
  append_unit(point > 0xFFFF ? 0xDC00 + (point & 0x3FFU) : point);
}

}  // namespace

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (std::string_view left = text; !left.empty();) {
    const std::size_t length = storage::utf8_length(left);
    const std::string_view character = left.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0)
      quoted += "\\ufffd";
    else if (character == "\"" || character == "\\" || storage::is_obeyed(character))
      append_escape(quoted, character);
    else
      quoted += character;
    left.remove_prefix(character.size());
  }
  return quoted + '"';
}

std::string json_number(double value) { return std::isfinite(value) ? formatted("%.17g", value) : "null"; }

}  // namespace clatter::app
