#include "io/toml_guard.hpp"

#include <algorithm>
#include <cstddef>

#include "io/place.hpp"
#include "io/text_file.hpp"

namespace clatter {
namespace {

constexpr int max_dots = 256;  ///< of one key; toml++ descends once for each part

/// The end of a quoted string that begins at `at`; where it is not closed, the end of its line (or text): toml++
/// reports that.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string delimiter(text.substr(at, 3) == std::string(3, quote) ? 3 : 1, quote);
  const bool one_line = delimiter.size() == 1;
  for (at += delimiter.size(); at < text.size(); ++at) {
    if (one_line && text[at] == '\n') return at;
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (text.substr(at, delimiter.size()) == delimiter) {
      return at + delimiter.size();
    }
  }
  return text.size();
}

bool ends_key(char character) { return std::string_view("\n=,[{").find(character) != std::string_view::npos; }

}  // namespace

void check_toml(const std::string& file, std::string_view text) {
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char character = text[at];
    if (character == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (character == '"' || character == '\'') {
      at = skip_string(text, at);
    } else {
      if (static_cast<unsigned char>(character) >= 0x80) {
        fail(place_of(file, text, at), "a character outside ASCII; put the text in quotes");
      }
      dots = ends_key(character) ? 0 : dots + (character == '.');
      if (dots > max_dots) fail(place_of(file, text, at), "more than 256 dots in a key; a key is SECTION.NAME");
      ++at;
    }
  }
}

}  // namespace clatter
