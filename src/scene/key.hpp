#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "scene/quantity.hpp"

namespace clatter {
inline namespace scene {

enum class Kind : std::uint8_t { text, names, number, interval, integer, flag, choice, choices };

/// The numbers that a key takes.
struct AllowedRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;      ///< the ends themselves are excluded
  bool above = false;     ///< the lower end is excluded
  bool not_zero = false;  ///< 0 is excluded
  bool or_zero = false;   ///< 0 is permitted too
  bool infinite = false;  ///< inf is permitted, and -inf if there is no lower bound
};

namespace ranges {

inline constexpr AllowedRange any_or_infinite{.infinite = true};
inline constexpr AllowedRange not_negative{.low = 0};
inline constexpr AllowedRange positive{.low = 0, .open = true};
inline constexpr AllowedRange positive_or_infinite{.low = 0, .open = true, .infinite = true};
inline constexpr AllowedRange not_zero{.not_zero = true};
inline constexpr AllowedRange zero_to_one{.low = 0, .high = 1};
inline constexpr AllowedRange above_zero_to_one{.low = 0, .high = 1, .above = true};

}  // namespace ranges

/// All that is known of a configuration key, as plain data: reading, validation, `clatter defaults`, the help and the
/// reference are made from it.
struct Key {
  std::string_view section;  ///< empty at the top level
  std::string_view name;
  Kind kind = Kind::number;
  std::string_view fallback;  ///< the default, as in INI; empty: none (a text: the empty text)
  std::string_view example;   ///< another value, as in INI
  std::string_view help;      ///< its meaning, without the range
  AllowedRange range{};
  std::span<const std::string_view> choices{};
  std::string_view other{};   ///< the key that gives the value if this one is not in use; the default is its too
  std::string_view beside{};  ///< TOML lines without which it has no effect, with a header if not all of its section
  Quantity quantity = Quantity::number;   ///< of its value; outside [machine] only beside a [machine]
  Quantity with_unit = Quantity::number;  ///< of its value if it has a unit; number: the same

  /// Whether the key has a value if neither it nor an alternative is given.
  [[nodiscard]] constexpr bool has_default() const {
    return other.empty() && (!fallback.empty() || kind == Kind::text || kind == Kind::names);
  }
};

/// A key that has no effect without these lines.
[[nodiscard]] constexpr Key with(std::string_view lines, Key key) {
  key.beside = lines;
  return key;
}

[[nodiscard]] constexpr Key one_of(std::span<const std::string_view> choices, Key key) {
  key.choices = choices;
  return key;
}

/// A key whose value is a quantity, and may have a unit.
[[nodiscard]] constexpr Key of(Quantity quantity, Key key) {
  key.quantity = quantity;
  return key;
}

/// A key whose value is another quantity if it has a unit.
[[nodiscard]] constexpr Key or_with_unit(Quantity quantity, Key key) {
  key.with_unit = quantity;
  return key;
}

/// A key whose value is that of another key if it isn't in use.
[[nodiscard]] constexpr Key or_as(std::string_view other, Key key) {
  key.other = other;
  return key;
}

}  // namespace scene
}  // namespace clatter
