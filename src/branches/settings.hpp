#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scene/parameter.hpp"

namespace clatter::branches {

/// The special points that can be followed in two parameters.
inline constexpr std::array<std::string_view, 5> curve_names{"fold", "flip", "symmetry breaking", "graze",
                                                             "Neimark-Sacker"};

/// Kinds of births: what begins at a special point of a branch, and isn't that branch going on.
enum class Birth : std::uint8_t {
  symmetry,  ///< two motions that are mirror images of each other, at a loss of symmetry
  flip,      ///< motion of twice the period
  graze      ///< motion with one contact more or fewer, on the side of the graze from which the branch came
};
/// In the order of `Birth`.
inline constexpr std::array<std::string_view, 3> birth_names{"symmetry", "flip", "graze"};

/// A value for each kind of birth.
template <class Value>
using OfBirths = std::array<Value, birth_names.size()>;

namespace detail {

inline constexpr Parameter by_default("nu");

}  // namespace detail

/// How a branch is followed; [branch] of a configuration.
struct BranchSettings {
  Parameter along = detail::by_default;
  std::array<double, 2> range{};         ///< of that parameter, low and high
  std::optional<Parameter> across{};     ///< second parameter, of a curve of special points
  std::array<double, 2> across_range{};  ///< of that parameter, low and high, or infinite
  std::string curve{};                   ///< one of curve_names; empty without a second parameter
  std::int64_t period = 0;          ///< forcing periods of the motion near x0, v0; 0: that which the scene settles on
  double tolerance = 1e-12;         ///< of Newton's method, relative
  double largest_step = 0.02;       ///< over the width of the range
  std::int64_t max_points = 10000;  ///< of all branches together
  std::int64_t generations = 0;     ///< of what is born at flips and symmetry breaking that are followed, too
  std::optional<OfBirths<bool>> births{};  ///< the kinds that are followed, if they were chosen; else all

  [[nodiscard]] bool follows(Birth kind) const { return !births || (*births)[static_cast<std::size_t>(kind)]; }
};

}  // namespace clatter::branches
