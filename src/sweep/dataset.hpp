#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace clatter::sweep {

/// The values of one variable, row-major over its dimensions.
using ValueArray =
    std::variant<std::vector<double>, std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::int64_t>>;

using Attribute = std::pair<std::string, std::variant<std::string, double, std::vector<std::uint8_t>>>;

/// A named array of results. A variable that has the name of its only dimension is that dimension's coordinate.
struct Variable {
  std::string name;
  std::vector<std::string> dimensions;  ///< names, slowest first; empty: a scalar
  ValueArray values;
  std::string long_name;
  std::string units;                    ///< "1", or "rad" for phases
  std::vector<Attribute> attributes{};  ///< beyond long_name and units, e.g. flag_values; _FillValue is the writer's
};

struct NamedLength {
  std::string name;
  std::size_t length = 0;
};

/// What a sweep gives: dimensions and the variables over them, in the order of the file.
struct Dataset {
  std::vector<NamedLength> dimensions;
  std::vector<Variable> variables;
  std::vector<Attribute> attributes{};  ///< of the whole, beyond its origin
};

}  // namespace clatter::sweep
