#include "sweep/parameter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sweep/sweep.hpp"

namespace clatter::sweep {
namespace {

using enum Parameter;

/// The keys in the order of the enumeration.
constexpr std::array<std::string_view, 30> keys{"h",
                                                "f",
                                                "nu",
                                                "phase",
                                                "R",
                                                "xs",
                                                "stop_lower",
                                                "stop_upper",
                                                "R_lower",
                                                "R_upper",
                                                "load",
                                                "x0",
                                                "v0",
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
                                                "gap",
                                                "start_period"};
static_assert(keys[static_cast<std::size_t>(start_period)] == "start_period");

void set_symmetric_stops(Stops& stops, double xs_value) {
  stops.lower = -std::abs(xs_value);
  stops.upper = std::abs(xs_value);
}

/// The start just after the contact with the lower stop (eq. 36: from x = 0 to the stop it takes a quarter of the
/// period).
void set_start(point::Problem& scene, double period) {
  scene.start.displacement = scene.stops.lower;
  scene.start.velocity = scene.stops.upper / std::tan(period / 4);
}

}  // namespace

std::string_view key_of(Parameter parameter) { return keys[static_cast<std::size_t>(parameter)]; }

std::optional<Parameter> parameter_of(std::string_view key) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found == keys.end()) return std::nullopt;
  return static_cast<Parameter>(found - keys.begin());
}

void set(point::Problem& scene, Parameter parameter, double value) {
  switch (parameter) {
    case h:
      scene.oscillator.damping = value;
      break;
    case f:
      scene.oscillator.forcing = value;
      break;
    case nu:
      scene.oscillator.frequency = value;
      break;
    case load:
      scene.oscillator.load = value;
      break;
    case stiffness:
      scene.oscillator.stiffness = value;
      break;
    case phase:
      scene.start.phase = value;
      break;
    case x0:
      scene.start.displacement = value;
      break;
    case v0:
      scene.start.velocity = value;
      break;
    case xs:
    case gap:
      set_symmetric_stops(scene.stops, value);
      break;
    case stop_lower:
      scene.stops.lower = value;
      break;
    case stop_upper:
      scene.stops.upper = value;
      break;
    case R:
      scene.stops.restitution_lower = scene.stops.restitution_upper = value;
      break;
    case R_lower:
      scene.stops.restitution_lower = value;
      break;
    case R_upper:
      scene.stops.restitution_upper = value;
      break;
    case stop_amplitude:
      scene.shaking.stops = value;
      break;
    case base_amplitude:
      scene.shaking.base = value;
      break;
    case stop_stiffness:
      scene.stops.stiffness_lower = scene.stops.stiffness_upper = value;
      break;
    case stop_stiffness_lower:
      scene.stops.stiffness_lower = value;
      break;
    case stop_stiffness_upper:
      scene.stops.stiffness_upper = value;
      break;
    case stop_damping:
      scene.stops.damping_lower = scene.stops.damping_upper = value;
      break;
    case stop_damping_lower:
      scene.stops.damping_lower = value;
      break;
    case stop_damping_upper:
      scene.stops.damping_upper = value;
      break;
    case start_period:
      set_start(scene, value);
      break;
    case mass:
    case damping:
    case damping_ratio:
    case quality:
    case force:
    case frequency:
      break;  // of machines alone
  }
}

bool set(Machine& machine, Parameter parameter, double value) {
  const auto set_damping = [&](DampingGiven given) { machine.damping = value, machine.damping_given = given; };
  switch (parameter) {
    case mass:
      machine.mass = value;
      return true;
    case stiffness:
      machine.stiffness = value;
      return true;
    case damping:
      set_damping(DampingGiven::coefficient);
      return true;
    case damping_ratio:
      set_damping(DampingGiven::ratio);
      return true;
    case quality:
      set_damping(DampingGiven::quality);
      return true;
    case force:
      machine.force = value;
      return true;
    case frequency:
      machine.frequency = value;
      return true;
    case load:
      machine.load = value;
      return true;
    default:
      return false;
  }
}

Quantity quantity_of(Parameter parameter) {
  switch (parameter) {
    case phase:
      return Quantity::angle;
    case xs:
    case gap:
    case stop_lower:
    case stop_upper:
    case x0:
    case stop_amplitude:
    case base_amplitude:
      return Quantity::length;
    case v0:
      return Quantity::velocity;
    case mass:
      return Quantity::mass;
    case stiffness:
    case stop_stiffness:
    case stop_stiffness_lower:
    case stop_stiffness_upper:
      return Quantity::stiffness;
    case damping:
      return Quantity::damping;
    case force:
    case load:
      return Quantity::force;
    case frequency:
      return Quantity::frequency;
    default:
      return Quantity::number;
  }
}

}  // namespace clatter::sweep
