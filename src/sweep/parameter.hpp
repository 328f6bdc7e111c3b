#pragma once

#include <optional>
#include <string_view>

#include "point/problem.hpp"

namespace clatter::sweep {

/// A number of the scene that a sweep can vary, named by its key in [scene].
enum class Parameter { h, f, nu, phase, R, xs, stop_lower, stop_upper, R_lower, R_upper, load, x0, v0, start_period };

/// The key of a parameter, e.g. "nu".
[[nodiscard]] std::string_view key_of(Parameter parameter);

/// The parameter of a key; empty if no parameter has that name.
[[nodiscard]] std::optional<Parameter> parameter_of(std::string_view key);

/// Sets a parameter of the scene. `xs` sets both stops to -|xs| and +|xs|, `R` both restitutions;
/// `start_period` sets x0 and v0 from the lower stop, v0 = |xs| cot(start_period / 4) (eq. 36), so it is set after
/// the stops.
void set(point::Problem& scene, Parameter parameter, double value);

}  // namespace clatter::sweep
