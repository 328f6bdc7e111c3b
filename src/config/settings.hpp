#pragma once

#include <cstddef>
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
#include "scene/force_table.hpp"
#include "scene/parameter.hpp"

namespace clatter::config {

/// One value of a key's kind, or the values of an axis.
using Value = std::variant<std::string, double, std::int64_t, bool, Interval, AxisValues>;

/// A key that was given: one value, or several as an axis of [sweep], each of the key's kind and within its range.
struct Setting {
  const Key* key = nullptr;  ///< of an axis: the key of [scene] or [machine] that it varies
  Value value;
  SourceLocation key_location;
  SourceLocation location;               ///< of the value, or of all values
  Quantity quantity = Quantity::number;  ///< of the values of a key that has one, as they were written
  bool is_plain = false;                 ///< written without unit and pi

  [[nodiscard]] bool is_axis() const { return std::holds_alternative<AxisValues>(value); }
  /// The values of a key of [scene] or [machine], one unless it is an axis.
  [[nodiscard]] std::span<const double> numbers() const;
  /// The location of one of these values: its own as an element of a list, else that of the whole.
  [[nodiscard]] const SourceLocation& location_of(std::size_t index) const;
};

/// A setting that another one replaced: one of the file by one of the command line, or a value by an axis.
struct Replaced {
  std::string_view key;       ///< of the file's setting
  SourceLocation by, former;  ///< of the two settings
  std::string remark;         ///< ", which stays as 'stop_lower'", or empty
  std::size_t values = 0;     ///< of an axis that one value replaced; 0: of none
  bool is_surplus = false;    ///< a value beside an axis of the same parameter, both of the file or the command line
};

/// "--set scene.stop_upper=2 in place of 'xs', fig22.toml:7:1, which stays as 'stop_lower'"
[[nodiscard]] std::string to_string(const Replaced& replaced);

/// A force as it was measured: the rows of `force_table`, with forces as written, in N in [machine].
struct MeasuredForce {
  ForceTable table;
  double period = 0.0;  ///< from the first row to the last, in tau or s; 0 if the rows give phases
};

/// A configuration with valid keys and values, each by itself; how they go together is checked afterwards.
struct Settings {
  std::string file;
  std::vector<ParsedSection> sections;
  std::vector<Setting> values;  ///< with one value each, in the order of the text
  std::vector<Setting> axes;    ///< in the order of the text
  std::vector<Replaced> replaced{};
  std::string_view scene_section = "scene";       ///< that describes the scene: "scene", or "machine"
  std::optional<MeasuredForce> measured_force{};  ///< of `force_table`, once that is read

  /// Whether the scene is a machine, so that all quantities are in SI.
  [[nodiscard]] bool is_si() const { return scene_section == "machine"; }

  /// The setting with one value of a key, or nullptr if it is not given.
  [[nodiscard]] const Setting* find(std::string_view section, std::string_view name) const;

  /// The setting of a parameter in [sweep] or in the scene's section, or nullptr if it is in neither.
  [[nodiscard]] const Setting* given(Parameter parameter) const;

  /// The setting that places both stops: xs, of a machine gap.
  [[nodiscard]] const Setting* given_symmetric_stops() const;

  /// The parameter that a branch is followed along, or the second one of a curve, "across"; nothing if none is given.
  [[nodiscard]] std::optional<Parameter> followed(std::string_view key) const;

  /// The value given for a key of that type, or its default.
  [[nodiscard]] std::string text(std::string_view section, std::string_view name) const;
  [[nodiscard]] double number(std::string_view section, std::string_view name) const;
  [[nodiscard]] std::int64_t integer(std::string_view section, std::string_view name) const;
  [[nodiscard]] bool flag(std::string_view section, std::string_view name) const;
  [[nodiscard]] Interval interval(std::string_view section, std::string_view name) const;

  /// The location of a missing key: the header of its section, or the beginning of the file.
  [[nodiscard]] SourceLocation location_of_section(std::string_view name) const;
};

/// Checks every entry against the key table. Throws ConfigError at the first unknown key or wrong value.
[[nodiscard]] Settings check_keys(ParsedConfig parsed);

/// The key that says the same in the other one of [scene] and [machine]; empty if nothing does.
[[nodiscard]] std::string_view counterpart_of(std::string_view name);

/// Whether a written value, or one of a list, is a number with a unit.
[[nodiscard]] bool is_measure(const ParsedValue& written);

/// The quantity of a value as it was written: that which the key has with a unit if there is one.
[[nodiscard]] Quantity quantity_of(const Key& key, const ParsedValue& written);

/// The default of a key that has one, converted as a given value would be.
[[nodiscard]] Setting default_setting(const Key& key);

/// The example of a key, likewise.
[[nodiscard]] Setting example_setting(const Key& key);

/// Converts a written value to the key's kind and checks its range; with [machine] every quantity is in SI. Throws
/// ConfigError.
[[nodiscard]] Value convert(const Key& key, const ParsedValue& written, bool is_si = false);
[[nodiscard]] AxisValues convert_axis(const Key& key, const ParsedValue& written);

/// Refuses [branch] without the parameter along which a motion is followed, or a key of it without the second one.
[[noreturn]] void refuse_missing_along(const Settings& settings);
[[noreturn]] void refuse_missing_across(const Settings& settings, std::string_view key, const SourceLocation& location);

}  // namespace clatter::config
