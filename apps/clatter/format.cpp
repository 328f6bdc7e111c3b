#include "format.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

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

std::string coordinates_text(const sweep::Sweep& sweep, std::size_t point) {
  std::string text;
  if (sweep.direction == sweep::Direction::both)
    text = point < size_one_way(sweep) ? "direction = 1" : "direction = -1";
  each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
    (text += text.empty() ? "" : ", ") += axis.parameter.key();
    text += formatted(" = %.10g", value);
  });
  return text;
}

}  // namespace clatter::app
