#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace clatter::stepping {

enum class Method : std::uint8_t { exact, dopri5, moreau };

/// Names in the order of Method.
inline constexpr std::array<std::string_view, 3> method_names{"exact", "dopri5", "moreau"};

/// How a run ended: completed, or the reason why it stopped early.
enum class Outcome : std::uint8_t { completed, event_budget, not_finite, unresolved };

/// The limits of a run.
struct Limits {
  double impacts = 1e8;                                      ///< a run with more fails (event_budget)
  double periods = std::numeric_limits<double>::infinity();  ///< forcing periods, for the report of progress
};

/// The method that computes arcs and events, and its settings.
struct Integration {
  Method method = Method::exact;
  double tolerance = 1e-10;  ///< dopri5: error of a step, relative to the motion
  double step = 1e-3;        ///< moreau: in forcing periods
  double theta = 0.5;        ///< moreau: weight of a step's end in its mean, 0 ... 1
  bool shortcuts = true;     ///< exact: find steady motion by closed forms and Newton's method if they apply
  bool all_effects = false;  ///< simulate every effect and take no shortcut, for comparison
};

}  // namespace clatter::stepping
