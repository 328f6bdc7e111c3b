#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/reading.hpp"

namespace clatter::app {

enum class Comparison { equal, not_equal, less, at_most, greater, at_least };

/// What --where asks of points: nu=1.0, impact_speed < 0.4 m/s, word=LU.
struct Condition {
  std::string name;  ///< of an axis or a result, or a component of one, v_before[-1]
  Comparison comparison = Comparison::equal;
  std::optional<config::Reading> value{};  ///< nothing: it is no number
  std::string word{};                      ///< the value as it was written
};

/// The text of a condition, for a message: "nu=1.0".
[[nodiscard]] std::string text_of(const Condition& condition);

/// Reads a condition. Throws ChoiceError.
[[nodiscard]] Condition condition_of(const std::string& text);

/// Whether a number compares as asked; `same` is the distance of numbers that count as equal. NaN never does.
[[nodiscard]] bool holds(double number, Comparison comparison, double asked, double same);

/// Whether no number compares as both ask.
[[nodiscard]] bool exclude(Comparison one, double asked, Comparison other, double asked_by_other);

}  // namespace clatter::app
