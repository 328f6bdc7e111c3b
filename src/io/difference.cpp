#include "io/difference.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include "io/utf8.hpp"

namespace clatter {
namespace {

/// The lines of a configuration, each with its section.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::string section;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('[')) section = line + ' ';
    if (!line.empty() && !line.starts_with('[')) lines.push_back(section + line);
  }
  return lines;
}

/// In the order of the text.
std::vector<std::string> only_in(const std::vector<std::string>& one, std::vector<std::string> other) {
  std::ranges::sort(other);
  std::vector<std::string> lines = one;
  std::erase_if(lines, [&](const std::string& line) { return std::ranges::binary_search(other, line); });
  return lines;
}

}  // namespace

std::string difference(const NamedText& one, const NamedText& other) {
  constexpr std::size_t most = 6;
  const std::vector<std::string> ones = lines_of(one.text), others = lines_of(other.text);
  std::string text;
  std::size_t shown = 0;
  const auto show = [&](const std::string& name, const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
      if (++shown <= most) text.append("\n  ").append(name).append(printable(line));
  };
  show(one.name, only_in(ones, others)), show(other.name, only_in(others, ones));
  if (shown == 0) text = "\n  the same lines in another order: the first axis varies slowest";
  if (shown > most) text += "\n  and " + std::to_string(shown - most) + " more lines";
  return text;
}

}  // namespace clatter
