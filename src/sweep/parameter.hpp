#pragma once

#include <optional>
#include <string_view>

#include "point/problem.hpp"
#include "sweep/scaling.hpp"

namespace clatter::sweep {

/// A number of the scene that a sweep can vary, named by its key in [scene] or [machine].
enum class Parameter {
  h,
  f,
  nu,
  phase,
  R,
  xs,
  stop_lower,
  stop_upper,
  R_lower,
  R_upper,
  load,
  x0,
  v0,
  stiffness,
  stop_amplitude,
  base_amplitude,
  stop_stiffness,
  stop_stiffness_lower,
  stop_stiffness_upper,
  stop_damping,
  stop_damping_lower,
  stop_damping_upper,
  mass,
  damping,
  damping_ratio,
  quality,
  force,
  frequency,
  gap,
  start_period
};

/// The key of a parameter, e.g. "nu".
[[nodiscard]] std::string_view key_of(Parameter parameter);

/// The parameter of a key; empty if no parameter has that name.
[[nodiscard]] std::optional<Parameter> parameter_of(std::string_view key);

/// Sets a parameter of the scene. `xs` and `gap` set both stops to -|xs| and +|xs|, `R` both restitutions,
/// `stop_stiffness` and `stop_damping` those of both stops; `start_period` sets x0 and v0 from the lower stop, v0 =
/// |xs| cot(start_period / 4) (eq. 36), so it is set after the stops.
void set(point::Problem& scene, Parameter parameter, double value);

/// Sets a parameter of a machine; returns false if it isn't one of mass, spring, damper and force.
[[nodiscard]] bool set(Machine& machine, Parameter parameter, double value);

/// The quantity that a parameter of [machine] is.
[[nodiscard]] Quantity quantity_of(Parameter parameter);

}  // namespace clatter::sweep
