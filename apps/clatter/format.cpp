#include "format.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

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

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') {
      quoted += {'\\', character};
    } else if (static_cast<unsigned char>(character) < 0x20 || character == 0x7F) {
      std::array<char, 8> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(character));
      quoted += escaped.data();
    } else {
      quoted += character;
    }
  }
  return quoted + '"';
}

std::string json_number(double value) { return std::isfinite(value) ? formatted("%.17g", value) : "null"; }

}  // namespace clatter
