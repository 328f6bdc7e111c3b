#include "format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>

#include "io/utf8.hpp"

namespace clatter {

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

/// A character as JSON escapes it, by its UTF-16 units.
std::string json_escape(std::string_view character) {
  if (character.size() == 1 && (character[0] == '"' || character[0] == '\\')) return {'\\', character[0]};
  const auto unit = static_cast<unsigned>(code_point(character));  // all that are obeyed have one unit
  std::array<char, 8> escaped{};
  std::snprintf(escaped.data(), escaped.size(), "\\u%04x", unit);
  return escaped.data();
}

}  // namespace

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (std::string_view left = text; !left.empty();) {
    const std::size_t length = utf8_length(left);
    const std::string_view character = left.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0)
      quoted += "\\ufffd";
    else if (character == "\"" || character == "\\" || is_obeyed(character))
      quoted += json_escape(character);
    else
      quoted += character;
    left.remove_prefix(character.size());
  }
  return quoted + '"';
}

std::string json_number(double value) { return std::isfinite(value) ? formatted("%.17g", value) : "null"; }

}  // namespace clatter
