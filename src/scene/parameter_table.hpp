#pragma once

#include <array>
#include <numbers>
#include <string_view>

#include "scene/loose_rows.hpp"
#include "scene/order_rows.hpp"
#include "scene/parameter_row.hpp"
#include "scene/restitution_rows.hpp"
#include "scene/stop_rows.hpp"

namespace clatter {
inline namespace scene {

namespace detail {

constexpr std::string_view friction_only = "friction = 0.2\n", gap_only = "gap = 3e-3\n",
                           mass_stops_force = "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nforce = 40.0\n",
                           square_force =
                               "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nforce = 40.0\n"
                               "frequency = 25.0\nforce_shape = \"square\"\n",
                           trapezoid_force =
                               "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nforce = 40.0\n"
                               "frequency = 25.0\nforce_shape = \"trapezoid\"\n",
                           measured_force =
                               "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nfrequency = 25.0\n"
                               "force_table = \"period, force (N); 0, 40; 0.5, -40; 1, 40\"\n";

}  // namespace detail

/// The rows of the table, with the places of numbers of a type.
template <class Number>
constexpr auto parameter_rows() {
  using namespace clatter::scene::detail;
  using namespace clatter::scene::ranges;
  using enum Quantity;
  using Given = BasicGivenScene<Number>;
  using Parts = BasicScene<Number>;
  using O = BasicOscillator<Number>;
  using B = BasicStart<Number>;
  using K = BasicShaking<Number>;
  using F = BasicFriction<Number>;
  using W = BasicForceShape<Number>;
  using Row = ParameterRow<Number>;
  constexpr auto o = &Parts::oscillator;
  constexpr auto b = &Parts::start;
  constexpr auto k = &Parts::shaking;
  constexpr auto dry = &Parts::friction;
  const std::array before_stops{
      Row{.key = "mass",
          .quantity = mass,
          .range = positive,
          .in_machine = {"", "250 g", "moving mass", gap_only, "mass"},
          .place = at<Number, &Given::mass>},
      Row{.key = "h",
          .range = not_negative,
          .in_scene = {"0", "0.05", "damping ratio: x' has the factor 2 h", "", "damping ratio"},
          .counterpart = "damping_ratio",
          .role = Role::damping,
          .place = in<Number, o, &O::damping>},
      Row{.key = "stiffness",
          .quantity = stiffness,
          .in_scene = {"1", "4",
                       "stiffness k of the spring, per unit mass; 0: no spring, negative: it pushes away from x = 0. "
                       "With k not 1, h is half the damping, f and load are forces, each per unit mass",
                       "", "stiffness of the spring"},
          .in_machine = {"0", "800 N/m", "stiffness of the spring; 0: no spring, negative: it pushes away from x = 0",
                         "mass = 0.25\ngap = 3e-3\n", "stiffness of the spring"},
          .place = in<Number, o, &O::stiffness>},
      Row{.key = "damping",
          .quantity = damping,
          .range = not_negative,
          .in_machine = {"0", "1.5 N s/m", "coefficient of the damper, whose force is that times the velocity",
                         mass_spring_stops, "damping coefficient"},
          .role = Role::damping,
          .place = at<Number, &Given::damper>},
      Row{.key = "damping_ratio",
          .range = not_negative,
          .in_machine = {"", "0.05", "damping over 2 (|stiffness| mass)^(1/2), in place of damping; needs a spring",
                         mass_spring_stops, "damping ratio"},
          .counterpart = "h",
          .role = Role::damping,
          .place = at<Number, &Given::damping_ratio>},
      Row{.key = "quality",
          .range = positive,
          .in_machine = {"", "10", "(|stiffness| mass)^(1/2) over the damping, in place of damping; needs a spring",
                         mass_spring_stops, "quality factor"},
          .role = Role::damping,
          .place = at<Number, &Given::quality>},
      Row{.key = "f",
          .in_scene = {"0", "-1", "force amplitude over stiffness; negative: in opposite phase", "",
                       "force amplitude over stiffness"},
          .counterpart = "force",
          .role = Role::drive,
          .place = in<Number, o, &O::forcing>},
      Row{.key = "force",
          .quantity = force,
          .in_machine = {"0", "40 N", "force amplitude; negative: in opposite phase", mass_stops_frequency,
                         "force amplitude"},
          .counterpart = "f",
          .role = Role::drive,
          .place = in<Number, o, &O::forcing>},
      Row{.key = "nu",
          .range = positive,
          .in_scene = {"1", "1.2", "excitation frequency over natural frequency", a_force,
                       "excitation over natural frequency"},
          .counterpart = "frequency",
          .place = in<Number, o, &O::frequency>},
      Row{.key = "frequency",
          .quantity = frequency,
          .range = positive,
          .in_machine = {"", "25 Hz",
                         "frequency of the force, and of stops or a base that move; needed if there is one of them. "
                         "Numbers without unit are in Hz, and rad/s is converted",
                         mass_stops_force, "excitation frequency"},
          .counterpart = "nu",
          .place = in<Number, o, &O::frequency>},
      Row{.key = "phase",
          .quantity = angle,
          .in_scene = {"0", "0.5", "phase of the force at tau = 0, rad; pi/2: a cosine", a_force,
                       "forcing phase at tau = 0"},
          .in_machine = {"0", "0.5 rad", "phase of the force at t = 0; pi/2: a cosine", forced,
                         "forcing phase at t = 0"},
          .role = Role::start,
          .place = in<Number, b, &B::phase>},
      Row{.key = "force_duty",
          .range = {.low = 0, .high = 1, .open = true},
          .in_scene = {"0.5", "0.3",
                       "share of the period of the first part of a force: of a square its +f, of a pulse its f, of a "
                       "half-sine the half wave",
                       "f = 1.0\nforce_shape = \"square\"\n", "share of the first part of the force"},
          .in_machine = {"0.5", "0.3",
                         "share of the period of the first part of a force: of a square its +force, of a pulse its "
                         "force, of a half-sine the half wave",
                         square_force, "share of the first part of the force"},
          .role = Role::force_shape,
          .place = of_law<Number, o, &O::shape, &W::duty>},
      Row{.key = "force_rise",
          .range = {.low = 0, .high = 0.5, .above = true},
          .in_scene = {"0.25", "0.1", "share of the period in which a trapezoid rises from -f to f, and falls again",
                       "f = 1.0\nforce_shape = \"trapezoid\"\n", "share of the rise of the force"},
          .in_machine = {"0.25", "0.1",
                         "share of the period in which a trapezoid rises from -force to force, and falls again",
                         trapezoid_force, "share of the rise of the force"},
          .role = Role::force_shape,
          .place = of_law<Number, o, &O::shape, &W::rise>},
      Row{.key = "force_factor",
          .in_scene = {"1", "-0.5", "factor by which the forces of force_table are multiplied",
                       "force_table = \"period, f; 0, 1; 0.5, -1; 1, 1\"\n", "factor of the measured force"},
          .in_machine = {"1", "-0.5", "factor by which the forces of force_table are multiplied", measured_force,
                         "factor of the measured force"},
          .role = Role::force_shape,
          .place = at<Number, &Given::force_factor>},
  };
  const std::array after_stops{
      Row{.key = "load",
          .quantity = force,
          .in_scene = {"0", "-0.2", "constant force over stiffness", "", "constant force over stiffness"},
          .in_machine = {"0", "-2 N", "constant force", mass_spring_stops, "constant force"},
          .role = Role::load,
          .place = in<Number, o, &O::load>},
      Row{.key = "friction",
          .quantity = force,
          .range = not_negative,
          .in_scene =
              {"0", "0.2",
               "dry friction mu, a force in the unit of f: mu against the velocity, and at x' = 0 whatever force "
               "holds the mass, up to friction_static",
               "", "dry friction"},
          .in_machine = {"0", "2 N",
                         "dry friction, a force against the velocity, the coefficient times that which presses on the "
                         "slide; at rest whatever force holds the mass, up to friction_static",
                         mass_spring_stops, "dry friction"},
          .role = Role::friction,
          .place = in<Number, dry, &F::kinetic>},
      Row{.key = "friction_static",
          .quantity = force,
          .range = not_negative,
          .in_scene = {"", "0.5",
                       "static level of the dry friction, the largest force against which it holds a mass at rest, no "
                       "less than friction; without this key equal to it",
                       friction_only, "static friction"},
          .in_machine = {"", "5 N",
                         "static level of the dry friction, the largest force against which it holds a mass at rest, "
                         "no less than friction; without this key equal to it",
                         "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nfriction = 2.0\n", "static friction"},
          .role = Role::friction,
          .place = in<Number, dry, &F::static_level>},
      Row{.key = "stop_amplitude",
          .quantity = length,
          .in_scene = {"0", "0.1",
                       "amplitude of the motion of both stops: amplitude * sin(nu tau + phase); displacements, x0, v0 "
                       "and impact speeds are relative to them",
                       stops, "amplitude of the motion of both stops"},
          .in_machine = {"0", "1 mm",
                         "amplitude of the motion of both stops, in the phase of the force; displacements, x0, v0 and "
                         "impact speeds are relative to them",
                         mass_stops_frequency, "amplitude of the motion of both stops"},
          .role = Role::shaking,
          .place = in<Number, k, &K::stops>},
      Row{.key = "base_amplitude",
          .quantity = length,
          .in_scene = {"0", "0.1",
                       "amplitude of the motion of the base, which carries the stops: amplitude * sin(nu tau + phase); "
                       "displacements, x0, v0 and impact speeds are relative to it",
                       "", "amplitude of the motion of the base"},
          .in_machine = {"0", "1 mm",
                         "amplitude of the motion of the base, which carries the stops, in the phase of the force; "
                         "displacements, x0, v0 and impact speeds are relative to it",
                         mass_stops_frequency, "amplitude of the motion of the base"},
          .role = Role::shaking,
          .place = in<Number, k, &K::base>},
      Row{.key = "stop_phase",
          .quantity = angle,
          .in_scene = {"0", "0.5",
                       "phase by which stops or base lead the force, rad: they move as amplitude * sin(nu tau + phase "
                       "+ stop_phase)",
                       "xs = 1.0\nstop_amplitude = 0.1\n", "lead of the motion of stops or base over the force"},
          .in_machine = {"0", "0.5 rad", "lead of the motion of stops or base over the force",
                         "mass = 0.25\ngap = 3e-3\nfrequency = 25.0\nstop_amplitude = 1e-3\n",
                         "lead of the motion of stops or base over the force"},
          .place = in<Number, k, &K::phase>},
      Row{.key = "x0",
          .quantity = length,
          .in_scene = {"0", "0.2", "displacement at tau = 0, between the stops", "", "displacement at tau = 0"},
          .in_machine = {"0", "1 mm", "displacement at t = 0, between the stops", mass_spring_stops,
                         "displacement at t = 0"},
          .role = Role::start,
          .place = in<Number, b, &B::displacement>},
      Row{.key = "v0",
          .quantity = velocity,
          .in_scene = {"0", "-1.5", "velocity at tau = 0", "", "velocity at tau = 0"},
          .in_machine = {"0", "-0.2 m/s", "velocity at t = 0", mass_spring_stops, "velocity at t = 0"},
          .role = Role::start,
          .place = in<Number, b, &B::velocity>},
      Row{.key = "start_period",
          .range = {.low = 0, .high = 2 * std::numbers::pi, .open = true},
          .in_scene = {"", "3",
                       "start on the free motion that has this period, just after its contact with the lower stop; in "
                       "place of x0 and v0, only if h = f = load = 0, R = 1 and xs is given",
                       stops, "period of the free vibration that the start lies on"},
          .role = Role::start,
          .place = at<Number, &Given::start_period>},
  };
  return joined(before_stops, order_rows<Number>(), stop_rows<Number>(), restitution_rows<Number>(), after_stops,
                loose_rows<Number>(), loose_restitution_rows<Number>());
}

}  // namespace scene
}  // namespace clatter
