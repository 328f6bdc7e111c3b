#include "terminal/format.hpp"

#include <algorithm>
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

std::string unit_text(std::string_view units) {
  if (units == "1") return "";
  if (const std::size_t slash = units.find('/'); slash != std::string_view::npos) {  // of a derivative: m/(N m-1)
    std::string_view by = units.substr(slash + 1);
    if (by.starts_with('(') && by.ends_with(')')) by = by.substr(1, by.size() - 2);
    const std::string above = unit_text(units.substr(0, slash)), below = unit_text(by);
    const bool is_long = below.find_first_of("/ ") != std::string::npos;
    return (above.empty() ? "1" : above) + '/' + (is_long ? '(' + below + ')' : below);
  }
  std::string over, under;
  for (std::size_t begin = 0; begin < units.size();) {
    const std::size_t end = std::min(units.find(' ', begin), units.size());
    std::string_view factor = units.substr(begin, end - begin);
    const std::size_t minus = factor.find('-');
    if (minus == std::string_view::npos) {
      over.append(over.empty() ? "" : " ").append(factor);
    } else {
      const std::string_view power = factor.substr(minus + 1);
      under.append("/").append(factor.substr(0, minus)).append(power == "1" ? "" : power);
    }
    begin = end + 1;
  }
  return (over.empty() && !under.empty() ? "1" : over) + under;
}

}  // namespace clatter::app
