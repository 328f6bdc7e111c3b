#include "config/config_diff.hpp"

#include <algorithm>
#include <compare>
#include <string_view>
#include <vector>

#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

/// A line of a configuration and the heading of its section.
struct Line {
  std::string_view section, text;
  auto operator<=>(const Line&) const = default;
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::string_view section; !text.empty();) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.starts_with('[')) section = line;
    if (!line.empty() && !line.starts_with('[')) lines.push_back({section, line});
  }
  return lines;
}

/// The lines that only `one` has, in the order of the text.
std::vector<Line> only_in(const std::vector<Line>& one, std::vector<Line> other) {
  std::ranges::sort(other);
  std::vector<Line> lines = one;
  std::erase_if(lines, [&](const Line& line) { return std::ranges::binary_search(other, line); });
  return lines;
}

}  // namespace

std::string config_diff(const NamedText& one, const NamedText& other) {
  constexpr std::size_t most = 6;
  const std::vector<Line> ones = lines_of(one.text), others = lines_of(other.text);
  std::string text;
  std::size_t shown = 0;
  const auto show = [&](const std::string& name, const std::vector<Line>& lines) {
    for (const Line& line : lines) {
      if (++shown > most) continue;
      text.append("\n  ").append(name);
      if (!line.section.empty()) text.append(storage::excerpt(line.section)).append(" ");
      text.append(storage::excerpt(line.text));
    }
  };
  show(one.name, only_in(ones, others)), show(other.name, only_in(others, ones));
  if (shown == 0) text = "\n  the same lines in another order: the first axis varies slowest";
  if (shown > most) text += "\n  and " + std::to_string(shown - most) + " more lines";
  return text;
}

}  // namespace clatter::config
