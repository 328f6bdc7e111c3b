#include "sweep/parameter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace clatter::sweep {
namespace {

using enum Parameter;

/// The keys in the order of the enumeration.
constexpr std::array<std::string_view, 14> keys{"h",    "f",          "nu",         "phase",       "R",
                                                "xs",   "stop_lower", "stop_upper", "R_lower",     "R_upper",
                                                "load", "x0",         "v0",         "start_period"};
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
    case start_period:
      set_start(scene, value);
      break;
  }
}

}  // namespace clatter::sweep
