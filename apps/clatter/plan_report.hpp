#pragma once

#include <string>

#include "sweep/plan.hpp"

namespace clatter {

/// A plan for people.
[[nodiscard]] std::string plan_text(const Plan& plan, const Sweep& sweep, int threads);

/// A plan for scripts, schema "clatter-plan/1" (README, "What a sweep will do").
[[nodiscard]] std::string plan_json(const Plan& plan, const Sweep& sweep, int threads);

}  // namespace clatter
