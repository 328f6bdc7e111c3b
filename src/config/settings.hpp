#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/keys.hpp"
#include "config/parsed_config.hpp"
#include "config/value_grammar.hpp"
#include "sweep/parameter.hpp"

namespace clatter::config {

/// A key that has been given a value of its kind within its range.
struct Setting {
  const Key* key = nullptr;
  std::variant<std::string, double, std::int64_t, bool> value;
  SourceLocation key_location;
  SourceLocation location;  ///< of the value
};

/// A key of [sweep] that has been given values, each within the key's range.
struct SweptSetting {
  sweep::Parameter parameter = sweep::Parameter::nu;
  AxisValues axis;
  SourceLocation key_location;
  SourceLocation location;
};

/// What is written of a parameter, be it in [scene] or in [sweep].
struct Given {
  std::span<const double> values;
  std::span<const SourceLocation> locations;  ///< of the elements of a list; else empty
  SourceLocation key_location;
  SourceLocation location;          ///< of the value, or of all values
  std::optional<std::size_t> axis;  ///< its index among the axes

  [[nodiscard]] const SourceLocation& location_of(std::size_t index) const {
    return index < locations.size() ? locations[index] : location;
  }
};

/// A setting of the file in whose place one of the command line stands.
struct Displaced {
  sweep::Parameter gone = sweep::Parameter::nu;
  SourceLocation stands, stood;
  std::string rest;  ///< ", which stays as 'stop_lower'", or nothing
};

/// "--set scene.stop_upper=2 in place of 'xs', fig22.toml:7:1, which stays as 'stop_lower'"
[[nodiscard]] std::string to_string(const Displaced& displaced);

/// A configuration whose keys and values are right one by one; how they go together is checked afterwards.
struct Settings {
  std::string file;
  std::vector<ParsedSection> sections;
  std::vector<Setting> values;     ///< only what was given
  std::vector<SweptSetting> axes;  ///< in the order of the text
  std::vector<Displaced> displaced{};

  [[nodiscard]] const Setting* find(std::string_view section, std::string_view name) const;

  /// What is given for a parameter, or nothing.
  [[nodiscard]] std::optional<Given> given(sweep::Parameter parameter) const;

  /// The value of a key of that type: what was given, or the default.
  [[nodiscard]] std::string text(std::string_view section, std::string_view name) const;
  [[nodiscard]] double number(std::string_view section, std::string_view name) const;
  [[nodiscard]] std::int64_t integer(std::string_view section, std::string_view name) const;
  [[nodiscard]] bool flag(std::string_view section, std::string_view name) const;

  /// Where a key that is missing belongs: the section's header, or the beginning of the file.
  [[nodiscard]] SourceLocation place_of_section(std::string_view name) const;
};

/// Takes every entry through the table of keys. Throws ConfigError at the first unknown key or wrong value.
[[nodiscard]] Settings check_keys(ParsedConfig raw);

/// The default of a key that has one, so that defaults and given values take the same way.
[[nodiscard]] Setting default_setting(const Key& key);

/// The example of a key.
[[nodiscard]] Setting example_setting(const Key& key);

/// A value of the key's kind within its range, from what was written. Throws ConfigError.
[[nodiscard]] std::variant<std::string, double, std::int64_t, bool> convert(const Key& key, const ParsedValue& raw);
[[nodiscard]] AxisValues convert_axis(const Key& key, const ParsedValue& raw);

}  // namespace clatter::config
