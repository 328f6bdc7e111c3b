#include <algorithm>
#include <tuple>
#include <utility>

#define TOML_ASSERT(expression) ((void)0)  // toml++ 3.3 aborts on "[*", although it reports an error next
#include <toml++/toml.h>

#include "config/comma.hpp"
#include "config/keys.hpp"
#include "config/parsed_config.hpp"
#include "config/text_file.hpp"
#include "config/toml_guard.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

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
