#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/source_location.hpp"

namespace clatter::config {

struct ParsedValue;
using ParsedList = std::vector<ParsedValue>;

/// A value that no key takes, named as found: "a table", "a date".
struct Unsupported {
  std::string name;
};

/// A value as it was written, before the table of keys gives it a meaning.
struct ParsedValue {
  std::variant<std::string, bool, std::int64_t, double, ParsedList, Unsupported> data;
  SourceLocation location;
  bool untyped = false;  ///< INI and --set: the text may mean a number, a list or true and false
  int inset = 0;         ///< columns from the place to the first character of a text, e.g. 1 for its quote
};

struct ParsedEntry {
  std::string section;  ///< empty at the top level
  std::string key;
  SourceLocation location;
  ParsedValue value;
};

struct ParsedSection {
  std::string name;
  SourceLocation location;
};

/// A configuration as it was written: entries in the order of the text.
struct ParsedConfig {
  std::string file;
  std::vector<ParsedSection> sections;
  std::vector<ParsedEntry> entries;
};

/// Both readers throw ConfigError at the first thing that is no TOML, or no INI.
[[nodiscard]] ParsedConfig read_toml(const std::string& file, std::string_view text);
[[nodiscard]] ParsedConfig read_ini(const std::string& file, std::string_view text);

/// Puts every --set in place of the file's value of that key, or after the file's entries; the last of equal ones wins.
void apply_overrides(ParsedConfig& raw, const std::vector<Override>& overrides);

}  // namespace clatter::config
