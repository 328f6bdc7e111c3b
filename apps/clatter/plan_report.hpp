#pragma once

#include <optional>
#include <string>

#include "plan/plan.hpp"

namespace clatter::app {

/// A plan as text for people; `seconds` is the time of a run, if it is known.
[[nodiscard]] std::string plan_text(const plan::Plan& plan, const sweep::Sweep& sweep, int threads,
                                    std::optional<double> seconds);

/// A plan for scripts, schema "clatter-plan/1" (src/plan/README.md).
[[nodiscard]] std::string plan_json(const plan::Plan& plan, const sweep::Sweep& sweep, int threads,
                                    std::optional<double> seconds);

}  // namespace clatter::app
