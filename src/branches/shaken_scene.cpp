#include "branches/shaken_scene.hpp"

#include <cmath>

namespace clatter::branches {
namespace {

using sweep::Parameter;

double& reference_to(ShakenScene& scene, Parameter parameter) {
  switch (parameter) {
    case Parameter::h:
      return scene.oscillator.damping;
    case Parameter::f:
      return scene.oscillator.forcing;
    case Parameter::nu:
      return scene.oscillator.frequency;
    case Parameter::load:
      return scene.oscillator.load;
    case Parameter::stiffness:
      return scene.oscillator.stiffness;
    case Parameter::mass:
      return scene.inverse_mass;
    case Parameter::stop_amplitude:
      return scene.shaking.stops;
    case Parameter::base_amplitude:
      return scene.shaking.base;
    case Parameter::stop_lower:
      return scene.stops.lower;
    case Parameter::R_lower:
      return scene.stops.restitution_lower;
    case Parameter::stop_stiffness_lower:
      return scene.stops.stiffness_lower;
    case Parameter::stop_stiffness:
    case Parameter::stop_stiffness_upper:
      return scene.stops.stiffness_upper;
    case Parameter::stop_damping_lower:
      return scene.stops.damping_lower;
    case Parameter::stop_damping:
    case Parameter::stop_damping_upper:
      return scene.stops.damping_upper;
    case Parameter::R:
    case Parameter::R_upper:
      return scene.stops.restitution_upper;
    default:
      return scene.stops.upper;
  }
}

}  // namespace

bool keeps_symmetry(const Scene& scene, Parameter parameter) {
  using enum sweep::Parameter;
  if (parameter == stiffness && mirror_centre(scene) != 0.0) return false;  // the equilibrium stays at 0 alone
  for (const sweep::Parameter of_one_side : {load, stop_lower, stop_upper, R_lower, R_upper, stop_stiffness_lower,
                                             stop_stiffness_upper, stop_damping_lower, stop_damping_upper})
    if (parameter == of_one_side) return false;
  return true;
}

ShakenScene changed(ShakenScene scene, Parameter parameter, double value) {
  if (parameter == Parameter::xs) value = std::abs(value);
  if (parameter == Parameter::mass)
    for (double* const per_mass :
         {&scene.oscillator.damping, &scene.oscillator.forcing, &scene.oscillator.load, &scene.oscillator.stiffness,
          &scene.stops.stiffness_lower, &scene.stops.stiffness_upper})
      *per_mass *= value / scene.inverse_mass;
  reference_to(scene, parameter) = value;
  if (parameter == Parameter::xs) scene.stops.lower = -value;
  if (parameter == Parameter::R) scene.stops.restitution_lower = value;
  if (parameter == Parameter::stop_stiffness) scene.stops.stiffness_lower = value;
  if (parameter == Parameter::stop_damping) scene.stops.damping_lower = value;
  return scene;
}

double value_of(const ShakenScene& scene, Parameter parameter) {
  ShakenScene copy = scene;
  return reference_to(copy, parameter);
}

}  // namespace clatter::branches
