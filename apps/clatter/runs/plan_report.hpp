#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plan/plan.hpp"

namespace clatter::app {

/// The name of a sweep's method, as in [integrator].
[[nodiscard]] std::string method_of(const sweep::Sweep& sweep);

/// Estimated wall time of a plan on so many threads.
[[nodiscard]] plan::Bounds seconds_of(const plan::Plan& plan, int threads);

/// A scene in the keys of [scene], in the units that it is computed in; empty if these are the user's.
using KeyAndNumber = std::pair<std::string_view, double>;
[[nodiscard]] std::vector<KeyAndNumber> computed_scene(const point::Problem& problem);

/// A plan as text for people; `seconds` is the time of a run, if it is known.
[[nodiscard]] std::string plan_text(const plan::Plan& plan, const sweep::Sweep& sweep, int threads,
                                    std::optional<double> seconds);

}  // namespace clatter::app
