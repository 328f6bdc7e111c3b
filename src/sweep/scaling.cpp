#include "sweep/scaling.hpp"

#include <cmath>
#include <numbers>

namespace clatter::sweep {
namespace {

/// Gives the start and the times of a problem a unit of time of its own.
void to_units(point::Problem& problem, const Units& units) {
  problem.units = units;
  problem.start.velocity *= units.time;
  problem.time.duration /= units.time;
  for (double* const kappa : {&problem.stops.stiffness_lower, &problem.stops.stiffness_upper})
    *kappa *= units.time * units.time / units.mass;
  problem.observe.base_frequency *= units.is_si ? 2 * std::numbers::pi * units.time : units.time;
}

}  // namespace

Units units_of(const Machine& machine) {
  Units units{.time = 1.0, .mass = machine.mass, .is_si = true};
  if (machine.stiffness != 0) {
    units.time = std::sqrt(machine.mass / std::abs(machine.stiffness));
  } else if (machine.frequency != 0) {
    units.time = 1 / (2 * std::numbers::pi * machine.frequency);
  }
  return units;
}

Oscillator oscillator_of(const Machine& machine, const Units& units) {
  const double k = machine.stiffness;
  const double force = k != 0 ? std::abs(k) : machine.mass / (units.time * units.time);  // that gives a unit of x
  Oscillator oscillator;
  switch (machine.damping_given) {
    case DampingGiven::coefficient:
      oscillator.damping = machine.damping * units.time / (2 * machine.mass);
      break;
    case DampingGiven::ratio:
      oscillator.damping = machine.damping;
      break;
    case DampingGiven::quality:
      oscillator.damping = 1 / (2 * machine.damping);
      break;
  }
  oscillator.forcing = machine.force / force, oscillator.load = machine.load / force;
  oscillator.stiffness = k == 0 ? 0.0 : std::copysign(1.0, k);
  if (machine.frequency != 0 && k != 0) oscillator.frequency = 2 * std::numbers::pi * machine.frequency * units.time;
  return oscillator;
}

void to_computed_units(point::Problem& problem, Machine machine) {
  if (machine.force == 0 && !is_shaken(problem.shaking)) machine.frequency = 0;  // of nothing
  const Units units = units_of(machine);
  problem.oscillator = oscillator_of(machine, units);
  to_units(problem, units);
  Stops& stops = problem.stops;
  const std::array kappa{stops.stiffness_lower, stops.stiffness_upper};
  const std::array damping{&stops.damping_lower, &stops.damping_upper};
  for (const std::size_t i : {0u, 1u})  // c = 2 zeta (kappa m)^(1/2); of a rigid stop nothing is left
    if (machine.stop_damping_in_si[i]) *damping[i] *= units.time / (2 * machine.mass * std::sqrt(kappa[i]));
}

void to_computed_units(point::Problem& problem) {
  const double k = problem.oscillator.stiffness;
  if (k == 0 || std::abs(k) == 1) return;
  const double rate = natural_frequency(problem.oscillator);
  problem.oscillator = with_unit_spring(problem.oscillator);
  to_units(problem, {.time = 1 / rate});
}

}  // namespace clatter::sweep
