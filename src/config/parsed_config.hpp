#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/config_error.hpp"

namespace clatter::config {

struct Override;
struct ParsedValue;
using ParsedList = std::vector<ParsedValue>;

/// A value that no key takes, by the name of its kind: "a table", "a date".
struct Unsupported {
  std::string name;
};

/// A value as it was written, before the key table gives it a meaning.
struct ParsedValue {
  std::variant<std::string, bool, std::int64_t, double, ParsedList, Unsupported> data;
  SourceLocation location;
  bool untyped = false;  ///< INI and --set: the text may stand for a number, a list, true or false
  int inset = 0;         ///< columns from the location to the first character of a text, e.g. 1 for its quote
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

/// Both readers throw ConfigError at the first syntax error.
[[nodiscard]] ParsedConfig read_toml(const std::string& file, std::string_view text);
[[nodiscard]] ParsedConfig read_ini(const std::string& file, std::string_view text);

/// Replaces the file's value of a key by that of --set, or adds it after the file's entries; the last --set of a key
/// wins.
void apply_overrides(ParsedConfig& parsed, const std::vector<Override>& overrides);

}  // namespace clatter::config
