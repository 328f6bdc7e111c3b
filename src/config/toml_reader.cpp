#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>

#include "config/config_error.hpp"
#include "config/keys.hpp"
#include "config/look_alike.hpp"
#include "config/parsed_config.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"

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

/// Refuses a character outside ASCII where TOML takes none: one that looks like another, or a text without quotes.
[[noreturn]] void refuse_not_ascii(const std::string& file, std::string_view text, std::size_t at) {
  const std::string_view character = text.substr(at, storage::utf8_length(text.substr(at)));
  const std::string otherwise =
      "a character outside ASCII, " + name_of_character(character) + "; put the text in quotes";
  fail(location_of(file, text, at), look_alike_hint(character).value_or(otherwise));
}

/// Throws ConfigError at text that would crash toml++ 3.3: non-ASCII characters outside comments and quotes, and keys
/// of very many parts.
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
      if (!is_ascii(character)) refuse_not_ascii(file, text, at);
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

SourceLocation location_at(const std::string& file, const toml::source_position& position) {
  return {file, static_cast<int>(position.line), static_cast<int>(position.column)};
}

/// The name of a type that no key takes.
std::string name_of(toml::node_type type) {
  switch (type) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time";
    case toml::node_type::date_time:
      return "a date and time";
    default:
      return "a value of another kind";
  }
}

/// The width of the opening quote if a text is as long as its source, so that its characters have columns; else 0.
int inset_of(const std::string& text, const toml::source_region& region) {
  const bool plain =
      region.begin.line == region.end.line &&
      static_cast<int>(region.end.column) - static_cast<int>(region.begin.column) == storage::characters(text) + 2;
  return plain ? 1 : 0;
}

ParsedValue parsed_value(const std::string& file, const toml::node& node) {
  ParsedValue value;
  value.location = location_at(file, node.source().begin);
  if (const auto* const text = node.as_string()) {
    value.data = text->get();
    value.inset = inset_of(text->get(), node.source());
  } else if (const auto* const flag = node.as_boolean()) {
    value.data = flag->get();
  } else if (const auto* const integer = node.as_integer()) {
    value.data = integer->get();
  } else if (const auto* const number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* const array = node.as_array()) {
    ParsedList list;
    for (const toml::node& element : *array) list.push_back(parsed_value(file, element));
    value.data = std::move(list);
  } else {
    value.data = Unsupported{name_of(node.type())};
  }
  return value;
}

void add_entries(ParsedConfig& parsed, const std::string& section, const toml::table& table) {
  for (auto&& [key, node] : table) {
    const toml::table* const inner = node.as_table();
    if (section.empty() && inner != nullptr) {
      parsed.sections.push_back({std::string(key.str()), location_at(parsed.file, key.source().begin)});
      add_entries(parsed, std::string(key.str()), *inner);
    } else {
      parsed.entries.push_back({section, std::string(key.str()), location_at(parsed.file, key.source().begin),
                                parsed_value(parsed.file, node)});
    }
  }
}

std::string_view line_of(const SourceLocation& location, std::string_view text) {
  std::size_t begin = 0;
  for (int line = 1; line < location.line; ++line) begin = text.find('\n', begin) + 1;
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// A way out for a comma at a location: a decimal comma, or a list without brackets; empty if there is no comma.
std::string way_out_of_comma(const SourceLocation& location, std::string_view text) {
  const std::string_view line = line_of(location, text);
  std::size_t comma = line.find(',');
  while (comma != std::string_view::npos && 1 + storage::characters(line.substr(0, comma)) < location.column)
    comma = line.find(',', comma + 1);
  if (comma == std::string_view::npos || 1 + storage::characters(line.substr(0, comma)) > location.column) return {};
  const std::size_t begin = line.rfind('=', comma) + 1;  // npos + 1 is 0
  const std::string_view name = without_blanks(line.substr(0, begin - (begin > 0)));
  const auto key = std::ranges::find(keys(), name, &Key::name);
  const std::string hint =
      comma_hint(line.substr(begin, line.find('#', comma) - begin), key == keys().end() ? Kind::number : key->kind);
  return hint.empty() ? "; several values are an axis, in brackets and in [sweep]: nu = [0.8, 1.2]" : hint;
}

/// A way out of a syntax error, which toml++ doesn't give.
std::string way_out(std::string_view description, const SourceLocation& location, std::string_view text) {
  if (const std::string comma = way_out_of_comma(location, text); !comma.empty()) return comma;
  if (description.find("redefine") != std::string_view::npos) return "; each section and each key is given once";
  if (description.find("not representable") != std::string_view::npos) return "; the number is too large";
  return "; a line is KEY = VALUE, and texts and expressions stand in quotes: nu = \"linspace(0.5, 1.5, 501)\"";
}

/// Moves a location into the text: toml++ reports its end beyond the end of the last line.
SourceLocation within(SourceLocation location, std::string_view text) {
  const SourceLocation end = location_of(location.source, text, text.size());
  if (location.line >= end.line) return {end.source, end.line, std::min(location.column, end.column)};
  location.column = std::min(location.column, 1 + storage::characters(line_of(location, text)));
  return location;
}

/// Moves the location of a repeated key or of a number too large, which toml++ reports at their end, to their first
/// character.
SourceLocation start_of_token(SourceLocation location, std::string_view text, std::string_view description) {
  const bool at_end = description.find("redefine") != std::string_view::npos ||
                      description.find("could not be interpreted") != std::string_view::npos ||
                      description.find("not representable") != std::string_view::npos;
  if (!at_end) return location;
  const std::string_view line = line_of(location, text);
  const auto part_of_token = [&](int column) {
    const char character = line[static_cast<std::size_t>(column) - 1];
    return std::string_view(" \t=,[").find(character) == std::string_view::npos;
  };
  while (location.column > 1 && !part_of_token(location.column - 1)) --location.column;
  while (location.column > 1 && part_of_token(location.column - 1)) --location.column;
  return location;
}

/// Corrects two faults of toml++ 3.3 in quoting keys: escapes begin twice, and the blank after the key is included.
std::string corrected(std::string description) {
  if (description.find("redefine") == std::string::npos) return description;
  for (const std::string_view twice : {"\\u\\u", "\\U\\U"}) {
    for (std::size_t at = 0; (at = description.find(twice, at)) != std::string::npos;) description.erase(at, 2);
  }
  if (description.ends_with(" '")) description.erase(description.size() - 2, 1);
  return description;
}

toml::table parse(const std::string& file, std::string_view text) {
  check_toml(file, text);
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    const SourceLocation location = within(location_at(file, error.source().begin), text);
    fail(start_of_token(location, text, error.description()),
         corrected(std::string(error.description())) + way_out(error.description(), location, text));
  }
}

}  // namespace

ParsedConfig read_toml(const std::string& file, std::string_view text) {
  check_characters(file, text);
  ParsedConfig parsed{file, {}, {}};
  try {
    add_entries(parsed, "", parse(file, text));
  } catch (const ConfigError& error) {
    if (has_ending(file, ".toml")) throw;
    throw ConfigError(std::string(error.what()) + "; read as TOML; for INI give --ini, or a name that ends in .ini");
  }
  const auto order = [](const auto& left, const auto& right) {  // toml++ iterates in alphabetical order
    return std::tuple(left.location.line, left.location.column) <
           std::tuple(right.location.line, right.location.column);
  };
  std::sort(parsed.entries.begin(), parsed.entries.end(), order);
  std::sort(parsed.sections.begin(), parsed.sections.end(), order);
  return parsed;
}

}  // namespace clatter::config
