#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clatter::config {

enum class Kind : std::uint8_t { text, names, number, integer, flag, choice };

/// The numbers that a key takes.
struct AllowedRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;      ///< the ends themselves are excluded
  bool not_zero = false;  ///< 0 is excluded
  bool or_zero = false;   ///< 0 is permitted too
  bool infinite = false;  ///< -inf and inf are permitted
};

/// All that is known of a key: reading, validation, `clatter defaults`, the help and the README's reference are made
/// from it.
struct Key {
  std::string_view section;  ///< empty at the top level
  std::string_view name;
  Kind kind = Kind::number;
  std::string_view fallback;  ///< the default, as in INI; empty: none (a text: the empty text)
  std::string_view example;   ///< another value, as in INI
  std::string_view help;      ///< its meaning, without the range
  AllowedRange range{};
  std::span<const std::string_view> choices{};
  std::string_view other{};   ///< the key that gives the value where this one is not in use; the default is its too
  std::string_view beside{};  ///< TOML lines of its section without which it has no effect

  /// Whether the key has a value where neither it nor an alternative is given.
  [[nodiscard]] bool has_default() const {
    return other.empty() && (!fallback.empty() || kind == Kind::text || kind == Kind::names);
  }
};

/// Every key, in the order of the configuration's text.
[[nodiscard]] std::span<const Key> keys();

/// The sections in their order, without the top level.
[[nodiscard]] std::span<const std::string_view> sections();

/// The key of that name, or nullptr; in [sweep] every scene key is the key of an axis.
[[nodiscard]] const Key* find_key(std::string_view section, std::string_view name);

/// The names that a section takes.
[[nodiscard]] std::vector<std::string_view> key_names(std::string_view section);

/// Whether an INI value is free text, in which ';' and '#' begin a comment only after a blank.
[[nodiscard]] bool is_free_text(std::string_view section, std::string_view name);

[[nodiscard]] bool contains(const AllowedRange& range, double value);

/// What a key permits, for messages and for the help: "> 0", "0 ... 1", "true or false".
[[nodiscard]] std::string permitted(const Key& key);

}  // namespace clatter::config
