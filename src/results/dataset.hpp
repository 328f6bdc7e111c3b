#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace clatter::results {

/// The values of one variable, row-major over its dimensions; texts are UTF-8.
using ValueArray = std::variant<std::vector<double>, std::vector<std::uint8_t>, std::vector<std::int8_t>,
                                std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<std::string>>;

/// Gives the next values of a variable, as many as are asked for, from the first one to the last; they are made while
/// the variable is written, so that they are never all in memory.
using NextValues = std::function<ValueArray(std::size_t count)>;

/// Bytes of such values that are best made at a time, unless their variable says otherwise.
inline constexpr std::size_t made_at_once = 1UL << 20U;

using Attribute = std::pair<std::string, std::variant<std::string, double, std::vector<std::uint8_t>>>;

/// A named array of results. A variable that has the name of its only dimension is that dimension's coordinate.
struct Variable {
  std::string name;
  std::vector<std::string> dimensions;  ///< names, slowest first; empty: a scalar
  ValueArray values;                    ///< all of them, or none, but of their type, if there is `next`
  std::string long_name;
  std::string units;                    ///< "1", "rad" for phases; of a [machine] those of the SI
  std::vector<Attribute> attributes{};  ///< besides long_name and units, e.g. flag_values; the writer adds _FillValue
  std::string missing_if{};             ///< when a value is NaN or an empty text, in words for the help; not in files
  NextValues next{};                    ///< gives the values instead; empty: `values` has them
  std::size_t at_once = made_at_once;   ///< bytes of those
};

/// The names of all variables of texts, in files of any command; the others hold numbers.
inline constexpr std::array<std::string_view, 8> text_variables{
    "impact_word", "regime", "motion_word", "motion_regime", "word", "special_kind", "special_word", "special_regime"};

struct NamedLength {
  std::string name;
  std::size_t length = 0;
};

/// The results of a command: dimensions and the variables over them, in the order of the file.
struct Dataset {
  std::vector<NamedLength> dimensions;
  std::vector<Variable> variables;
  std::vector<Attribute> attributes{};  ///< of the file, besides those of its origin
};

/// Puts the values of all variables into `values`.
void collect(Dataset& dataset);

/// The values of a variable; nullptr if the dataset has none of this type and name.
template <class T>
[[nodiscard]] const std::vector<T>* values_of(const Dataset& dataset, std::string_view name) {
  for (const Variable& variable : dataset.variables)
    if (variable.name == name) return std::get_if<std::vector<T>>(&variable.values);
  return nullptr;
}

}  // namespace clatter::results
