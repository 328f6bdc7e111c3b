#include "config/toml_guard.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "config/source_location.hpp"
#include "config/text_file.hpp"

namespace clatter::config {
namespace {

constexpr int max_dots = 256;  ///< of one key; toml++ recurses once for each part

bool is_ascii(char character) { return static_cast<unsigned char>(character) < 0x80; }

/// The end of a quoted string that begins at `at`; if it is not closed, which toml++ reports, the end of its line or
/// text.
std::size_t skip_string(const std::string& file, std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string delimiter(text.substr(at, 3) == std::string(3, quote) ? 3 : 1, quote);
  const bool one_line = delimiter.size() == 1;
  for (at += delimiter.size(); at < text.size(); ++at) {
    if (one_line && text[at] == '\n') return at;
    if (quote == '"' && text[at] == '\\') {
      ++at;
      const std::size_t next = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
      if (next < text.size() && !is_ascii(text[next]))  // toml++ 3.3 expects the end of the line there
        fail(location_of(file, text, next), "a character outside ASCII after a backslash; leave the backslash out");
    } else if (text.substr(at, delimiter.size()) == delimiter) {
      at += delimiter.size();
      for (int more = 0; !one_line && more < 2 && at < text.size() && text[at] == quote; ++more)
        ++at;  // quotes that belong to the string
      return at;
    }
  }
  return text.size();
}

bool ends_key(char character) { return std::string_view("\n=,[{").find(character) != std::string_view::npos; }

/// Whether a character ends a number or bare word for toml++, which reads on over all others, even quotes and brackets.
bool ends_value(char character) { return std::string_view(" \t\n\r#,]}").find(character) != std::string_view::npos; }

bool opens_value(char character) { return std::string_view("=[{,").find(character) != std::string_view::npos; }

/// Tracks whether a key or a value comes next, as far as toml++ reads: up to the first mistake.
class Context {
 public:
  [[nodiscard]] bool in_value() const { return in_value_; }

  void read(char character) {
    if (character == '\n' && open_.empty()) in_value_ = false;
    if (!in_value_ && character == '=') {
      in_value_ = true;
    } else if (in_value_ && (character == '[' || character == '{')) {
      open_ += character;
      in_value_ = character == '[';
    } else if ((character == ']' || character == '}') && !open_.empty()) {
      open_.pop_back();
      in_value_ = true;
    } else if (character == ',' && !open_.empty()) {
      in_value_ = open_.back() == '[';
    }
  }

 private:
  std::string open_;  ///< brackets
  bool in_value_ = false;
};

}  // namespace

void check_toml(const std::string& file, std::string_view text) {
  int dots = 0;
  Context context;
  bool in_word = false;  // of a value, in which quotes mean nothing
  for (std::size_t at = 0; at < text.size();) {
    const char character = text[at];
    in_word = in_word && !ends_value(character);
    if (character == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if ((character == '"' || character == '\'') && !in_word) {
      at = skip_string(file, text, at);
    } else {
      if (!is_ascii(character)) fail(location_of(file, text, at), "a character outside ASCII; put the text in quotes");
      dots = ends_key(character) ? 0 : dots + (character == '.');
      if (dots > max_dots) fail(location_of(file, text, at), "more than 256 dots in a key; a key is SECTION.NAME");
      if (!in_word) {
        context.read(character);
        in_word = context.in_value() && !ends_value(character) && !opens_value(character);
      }
      ++at;
    }
  }
}

}  // namespace clatter::config
