#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "branches/followed.hpp"

namespace clatter::branches {

/// The keys of [scene] and of [machine] along which a motion can be followed.
inline constexpr std::array<std::string_view, 26> parameter_names{"h",
                                                                  "f",
                                                                  "nu",
                                                                  "R",
                                                                  "xs",
                                                                  "stop_lower",
                                                                  "stop_upper",
                                                                  "R_lower",
                                                                  "R_upper",
                                                                  "load",
                                                                  "stiffness",
                                                                  "stop_amplitude",
                                                                  "base_amplitude",
                                                                  "stop_stiffness",
                                                                  "stop_stiffness_lower",
                                                                  "stop_stiffness_upper",
                                                                  "stop_damping",
                                                                  "stop_damping_lower",
                                                                  "stop_damping_upper",
                                                                  "mass",
                                                                  "damping",
                                                                  "damping_ratio",
                                                                  "quality",
                                                                  "force",
                                                                  "frequency",
                                                                  "gap"};

/// The special points that can be followed in two parameters.
inline constexpr std::array<std::string_view, 4> curve_names{"fold", "flip", "symmetry breaking", "graze"};

/// How a branch is followed; [branch] of a configuration.
struct BranchSettings {
  Followed along = sweep::Parameter::nu;
  std::array<double, 2> range{};         ///< of that parameter of the computed scene, low and high
  std::optional<Followed> across{};      ///< second parameter, of a curve of special points
  std::array<double, 2> across_range{};  ///< of that parameter of the computed scene, low and high, or infinite
  std::string curve{};                   ///< one of curve_names; empty without a second parameter
  std::int64_t period = 0;          ///< forcing periods of the motion near x0, v0; 0: that which the scene settles on
  double tolerance = 1e-12;         ///< of Newton's method, relative
  double largest_step = 0.02;       ///< over the width of the range
  std::int64_t max_points = 10000;  ///< of all branches together
  std::int64_t generations = 0;     ///< of what is born at flips and symmetry breaking that are followed, too
};

}  // namespace clatter::branches
