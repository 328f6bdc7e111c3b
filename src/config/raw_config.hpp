#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/place.hpp"

namespace clatter {

struct RawValue;
using RawList = std::vector<RawValue>;

/// A value that no key takes, named as found: "a table", "a date".
struct Unsupported {
  std::string name;
};

/// A value as it was written, before the table of keys gives it a meaning.
struct RawValue {
  std::variant<std::string, bool, std::int64_t, double, RawList, Unsupported> data;
  Place place;
  bool untyped = false;  ///< INI and --set: the text may mean a number, a list or true and false
  int inset = 0;         ///< columns from the place to the first character of a text, e.g. 1 for its quote
};

struct RawEntry {
  std::string section;  ///< empty at the top level
  std::string key;
  Place place;
  RawValue value;
};

struct RawSection {
  std::string name;
  Place place;
};

/// A configuration as it was written: entries in the order of the text.
struct RawConfig {
  std::string file;
  std::vector<RawSection> sections;
  std::vector<RawEntry> entries;
};

/// Both readers throw ConfigError at the first thing that is no TOML, or no INI.
[[nodiscard]] RawConfig read_toml(const std::string& file, std::string_view text);
[[nodiscard]] RawConfig read_ini(const std::string& file, std::string_view text);

/// Puts every --set in place of the file's value of that key, or after the file's entries; the last of equal ones wins.
void apply_overrides(RawConfig& raw, const std::vector<Override>& overrides);

}  // namespace clatter
