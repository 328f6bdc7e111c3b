#pragma once

#include <string>

#include "plan/plan.hpp"

namespace clatter::app {

/// A plan as text for people.
[[nodiscard]] std::string plan_text(const plan::Plan& plan, const sweep::Sweep& sweep, int threads);

/// A plan for scripts, schema "clatter-plan/1" (src/plan/README.md).
[[nodiscard]] std::string plan_json(const plan::Plan& plan, const sweep::Sweep& sweep, int threads);

}  // namespace clatter::app
