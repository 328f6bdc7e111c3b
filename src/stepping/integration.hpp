#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace clatter::stepping {

enum class Method : std::uint8_t { exact, dopri5, moreau };

/// Names in the order of Method.
inline constexpr std::array<std::string_view, 3> method_names{"exact", "dopri5", "moreau"};

/// The method that computes arcs, impacts and rests, and its settings.
struct Integration {
  Method method = Method::exact;
  double tolerance = 1e-10;  ///< dopri5: error of a step, relative to the motion
  double step = 1e-3;        ///< moreau: in forcing periods
  double theta = 0.5;        ///< moreau: weight of a step's end in its mean, 0 ... 1
  bool shortcuts = true;     ///< exact: find steady motion by closed forms and Newton's method if they apply
  bool all_effects = false;  ///< simulate every effect and take no shortcut, for comparison
};

}  // namespace clatter::stepping
