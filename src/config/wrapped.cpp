#include "config/wrapped.hpp"

#include <algorithm>

namespace clatter::config {

std::string wrapped(std::string_view text, std::string_view margin) {
  const std::size_t width = help_width - margin.size();
  std::string lines;
  while (text.size() > width) {
    std::size_t blank = text.rfind(' ', width);
    if (blank == std::string_view::npos) blank = std::min(text.find(' '), text.size());  // a word longer than a line
    (lines += text.substr(0, blank)) += '\n';
    text.remove_prefix(std::min(blank + 1, text.size()));
    if (text.empty()) return lines;
    lines += margin;
  }
  return (lines += text) += '\n';
}

}  // namespace clatter::config
