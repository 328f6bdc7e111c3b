#pragma once

#include <optional>
#include <string_view>

#include "model/quantity.hpp"

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

/// The quantity that a parameter of [machine] is.
[[nodiscard]] Quantity quantity_of(Parameter parameter);

}  // namespace clatter::sweep
