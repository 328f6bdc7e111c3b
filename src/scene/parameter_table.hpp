#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string_view>

#include "scene/given_scene.hpp"
#include "scene/key.hpp"

namespace clatter {
inline namespace scene {

/// How a parameter acts on a scene.
enum class Role : std::uint8_t {
  other,
  start,        ///< it says where the motion begins
  damping,      ///< of the damper, in one of several ways
  drive,        ///< amplitude of the force
  load,         ///< constant force
  shaking,      ///< amplitude of stops or base
  position,     ///< of a stop
  restitution,  ///< of a rigid stop
  softness      ///< stiffness or damping of a soft stop
};

/// A key in one of [scene] and [machine].
struct KeyText {
  std::string_view fallback{};   ///< the default, as in INI; empty: none
  std::string_view example{};    ///< another value, as in INI
  std::string_view help{};       ///< its meaning, without the range; empty: no key of that section
  std::string_view beside{};     ///< lines of TOML without which it has no effect
  std::string_view long_name{};  ///< of its axis in results
};

/// All that is known of a parameter of the scene. Reading, validation, help, defaults, axes of [sweep], [branch], names
/// and units of results, symmetry and derivatives are made from it.
template <class Number>
struct ParameterRow {
  std::string_view key;
  Quantity quantity = Quantity::number;  ///< of its value in SI
  AllowedRange range{};
  KeyText in_scene{}, in_machine{};
  std::string_view other{};        ///< the key that gives the value of both sides, in its place
  std::string_view counterpart{};  ///< the key that says the same in the other section
  Role role = Role::other;
  Side side = Side::none;     ///< of the stop that it belongs to, if it is of one of them
  bool is_with_unit = false;  ///< the key of the row before, if its value has a unit
  using Place = Number& (*)(BasicGivenScene<Number>&);
  Place place = nullptr, place_of_upper = nullptr;  ///< the second one of a key of both stops, whose first is the lower
};

namespace detail {

constexpr AllowedRange any{};
constexpr AllowedRange any_or_infinite{.infinite = true};
constexpr AllowedRange not_negative{.low = 0};
constexpr AllowedRange positive{.low = 0, .open = true};
constexpr AllowedRange positive_or_infinite{.low = 0, .open = true, .infinite = true};
constexpr AllowedRange not_zero{.not_zero = true};
constexpr AllowedRange zero_to_one{.low = 0, .high = 1};

constexpr std::string_view a_force = "f = 1.0\n", stops = "xs = 1.0\n", soft = "xs = 1.0\nstop_stiffness = 100.0\n";
constexpr std::string_view some_mass = "mass = 0.25\n", mass_stops = "mass = 0.25\ngap = 3e-3\n",
                           gap_only = "gap = 3e-3\n", mass_soft = "mass = 0.25\ngap = 3e-3\nstop_stiffness = 1e5\n",
                           mass_spring_stops = "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\n",
                           mass_stops_frequency = "mass = 0.25\ngap = 3e-3\nfrequency = 25.0\n",
                           mass_stops_force = "mass = 0.25\ngap = 3e-3\nforce = 40.0\n",
                           forced = "mass = 0.25\ngap = 3e-3\nforce = 40.0\nfrequency = 25.0\n";

/// The number of a scene that a member of one of its parts is.
template <class Number, auto part, auto member>
constexpr Number& in(BasicGivenScene<Number>& scene) {
  return scene.*part.*member;
}
template <class Number, auto member>
constexpr Number& at(BasicGivenScene<Number>& scene) {
  return scene.*member;
}

}  // namespace detail

/// The rows of the table, with the places of numbers of a type.
template <class Number>
constexpr auto parameter_rows() {
  using namespace clatter::scene::detail;
  using enum Quantity;
  using Given = BasicGivenScene<Number>;
  using Parts = BasicScene<Number>;
  using O = BasicOscillator<Number>;
  using S = BasicStops<Number>;
  using B = BasicStart<Number>;
  using K = BasicShaking<Number>;
  using Row = ParameterRow<Number>;
  constexpr auto o = &Parts::oscillator;
  constexpr auto s = &Parts::stops;
  constexpr auto b = &Parts::start;
  constexpr auto k = &Parts::shaking;
  return std::array{
      Row{.key = "mass",
          .quantity = mass,
          .range = positive,
          .in_machine = {"", "250 g", "the mass that moves", gap_only, "mass"},
          .place = at<Number, &Given::mass>},
      Row{.key = "h",
          .range = not_negative,
          .in_scene = {"0", "0.05", "damping ratio: 2 h is the factor of x'", "", "damping ratio"},
          .counterpart = "damping_ratio",
          .role = Role::damping,
          .place = in<Number, o, &O::damping>},
      Row{.key = "stiffness",
          .quantity = stiffness,
          .range = any,
          .in_scene = {"1", "4",
                       "k of the spring, in units in which mass is 1; 0: none, negative: pushes away from x = 0. With "
                       "k not 1, h is half the damping over the mass, f and load are forces over the mass",
                       "", "stiffness of the spring"},
          .in_machine = {"0", "800 N/m", "of the spring; 0: none, negative: pushes away from x = 0", mass_stops,
                         "stiffness of the spring"},
          .place = in<Number, o, &O::stiffness>},
      Row{.key = "damping",
          .quantity = damping,
          .range = not_negative,
          .in_machine = {"0", "1.5 N s/m", "force of the damper over the velocity", mass_stops, "damping coefficient"},
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
          .range = any,
          .in_scene = {"0", "-1", "force amplitude over stiffness; negative: a phase shift of pi", "",
                       "force amplitude over stiffness"},
          .counterpart = "force",
          .role = Role::drive,
          .place = in<Number, o, &O::forcing>},
      Row{.key = "force",
          .quantity = force,
          .range = any,
          .in_machine = {"0", "40 N", "force amplitude; negative: a phase shift of pi", mass_stops_frequency,
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
                         "of the force, and of stops or a base that move, which need it; numbers without unit are in "
                         "Hz, and rad/s is converted",
                         mass_stops_force, "excitation frequency"},
          .counterpart = "nu",
          .place = in<Number, o, &O::frequency>},
      Row{.key = "phase",
          .quantity = angle,
          .range = any,
          .in_scene = {"0", "0.5", "phase of the force at tau = 0, rad; pi/2: a cosine", a_force,
                       "forcing phase at tau = 0"},
          .in_machine = {"0", "0.5 rad", "phase of the force at t = 0; pi/2: a cosine", forced,
                         "forcing phase at t = 0"},
          .role = Role::start,
          .place = in<Number, b, &B::phase>},
      Row{.key = "R",
          .range = zero_to_one,
          .in_scene = {"1", "0.7", "restitution of velocity on both stops", stops, "restitution of velocity"},
          .in_machine = {"1", "0.7", "restitution of velocity on both stops", mass_stops, "restitution of velocity"},
          .role = Role::restitution,
          .place = in<Number, s, &S::restitution_lower>,
          .place_of_upper = in<Number, s, &S::restitution_upper>},
      Row{.key = "xs",
          .quantity = length,
          .range = not_zero,
          .in_scene = {"", "-1", "symmetric stops at -|xs| and +|xs|", "", "place of the symmetric stops"},
          .counterpart = "gap",
          .role = Role::position,
          .place = in<Number, s, &S::lower>,
          .place_of_upper = in<Number, s, &S::upper>},
      Row{.key = "gap",
          .quantity = length,
          .range = positive,
          .in_machine = {"", "3 mm", "symmetric stops at -gap and +gap", some_mass,
                         "distance of the symmetric stops from the middle"},
          .counterpart = "xs",
          .role = Role::position,
          .place = in<Number, s, &S::lower>,
          .place_of_upper = in<Number, s, &S::upper>},
      Row{.key = "stop_lower",
          .quantity = length,
          .range = any_or_infinite,
          .in_scene = {"-inf", "-1", "lower stop, in place of xs; -inf: none", "", "place of the lower stop"},
          .in_machine = {"-inf", "-2 mm", "lower stop, in place of gap; -inf: none", some_mass,
                         "place of the lower stop"},
          .other = "xs",
          .role = Role::position,
          .side = Side::lower,
          .place = in<Number, s, &S::lower>},
      Row{.key = "stop_upper",
          .quantity = length,
          .range = any_or_infinite,
          .in_scene = {"inf", "2", "upper stop, in place of xs; inf: none", "", "place of the upper stop"},
          .in_machine = {"inf", "4 mm", "upper stop, in place of gap; inf: none", some_mass, "place of the upper stop"},
          .other = "xs",
          .role = Role::position,
          .side = Side::upper,
          .place = in<Number, s, &S::upper>},
      Row{.key = "R_lower",
          .range = zero_to_one,
          .in_scene = {"1", "0.5", "restitution of the lower stop, in place of R", stops,
                       "restitution of the lower stop"},
          .in_machine = {"1", "0.5", "restitution of the lower stop, in place of R", mass_stops,
                         "restitution of the lower stop"},
          .other = "R",
          .role = Role::restitution,
          .side = Side::lower,
          .place = in<Number, s, &S::restitution_lower>},
      Row{.key = "R_upper",
          .range = zero_to_one,
          .in_scene = {"1", "0.5", "restitution of the upper stop, in place of R", stops,
                       "restitution of the upper stop"},
          .in_machine = {"1", "0.5", "restitution of the upper stop, in place of R", mass_stops,
                         "restitution of the upper stop"},
          .other = "R",
          .role = Role::restitution,
          .side = Side::upper,
          .place = in<Number, s, &S::restitution_upper>},
      Row{.key = "stop_stiffness",
          .quantity = stiffness,
          .range = positive_or_infinite,
          .in_scene = {"inf", "100",
                       "kappa of both stops, in the unit of the spring's; inf: rigid. A soft stop, in place of R, "
                       "pushes with kappa times the depth beyond it plus damping, and never pulls",
                       stops, "stiffness of both stops"},
          .in_machine = {"inf", "100 N/mm",
                         "of both stops, in place of R; inf: rigid. A soft stop pushes with that times the depth "
                         "beyond it plus damping, and never pulls",
                         mass_stops, "stiffness of both stops"},
          .role = Role::softness,
          .place = in<Number, s, &S::stiffness_lower>,
          .place_of_upper = in<Number, s, &S::stiffness_upper>},
      Row{.key = "stop_stiffness_lower",
          .quantity = stiffness,
          .range = positive_or_infinite,
          .in_scene = {"inf", "100", "kappa of the lower stop, in place of stop_stiffness; inf: rigid", stops,
                       "stiffness of the lower stop"},
          .in_machine = {"inf", "90 N/m", "of the lower stop, in place of stop_stiffness", mass_stops,
                         "stiffness of the lower stop"},
          .other = "stop_stiffness",
          .role = Role::softness,
          .side = Side::lower,
          .place = in<Number, s, &S::stiffness_lower>},
      Row{.key = "stop_stiffness_upper",
          .quantity = stiffness,
          .range = positive_or_infinite,
          .in_scene = {"inf", "100", "kappa of the upper stop, in place of stop_stiffness; inf: rigid", stops,
                       "stiffness of the upper stop"},
          .in_machine = {"inf", "90 N/m", "of the upper stop, in place of stop_stiffness", mass_stops,
                         "stiffness of the upper stop"},
          .other = "stop_stiffness",
          .role = Role::softness,
          .side = Side::upper,
          .place = in<Number, s, &S::stiffness_upper>},
      Row{.key = "stop_damping",
          .range = not_negative,
          .in_scene = {"0", "0.1", "damping ratio zeta of both soft stops: 2 zeta kappa^(1/2) is the factor of x'",
                       soft, "damping ratio of both stops"},
          .in_machine = {"0", "0.1",
                         "damping ratio of both soft stops, damping over 2 (stop_stiffness mass)^(1/2); with a unit, "
                         "as 40 N s/m, the damping",
                         mass_soft, "damping ratio of both stops"},
          .role = Role::softness,
          .place = in<Number, s, &S::damping_lower>,
          .place_of_upper = in<Number, s, &S::damping_upper>},
      Row{.key = "stop_damping",
          .quantity = damping,
          .range = not_negative,
          .in_machine = {"", "", "", "", "damping coefficient of both stops"},
          .role = Role::softness,
          .is_with_unit = true,
          .place = at<Number, &Given::stop_damper_lower>,
          .place_of_upper = at<Number, &Given::stop_damper_upper>},
      Row{.key = "stop_damping_lower",
          .range = not_negative,
          .in_scene = {"0", "0.1", "damping ratio of the lower soft stop, in place of stop_damping", soft,
                       "damping ratio of the lower stop"},
          .in_machine = {"0", "0.1", "of the lower soft stop, in place of stop_damping", mass_soft,
                         "damping ratio of the lower stop"},
          .other = "stop_damping",
          .role = Role::softness,
          .side = Side::lower,
          .place = in<Number, s, &S::damping_lower>},
      Row{.key = "stop_damping_lower",
          .quantity = damping,
          .range = not_negative,
          .in_machine = {"", "", "", "", "damping coefficient of the lower stop"},
          .role = Role::softness,
          .side = Side::lower,
          .is_with_unit = true,
          .place = at<Number, &Given::stop_damper_lower>},
      Row{.key = "stop_damping_upper",
          .range = not_negative,
          .in_scene = {"0", "0.1", "damping ratio of the upper soft stop, in place of stop_damping", soft,
                       "damping ratio of the upper stop"},
          .in_machine = {"0", "0.1", "of the upper soft stop, in place of stop_damping", mass_soft,
                         "damping ratio of the upper stop"},
          .other = "stop_damping",
          .role = Role::softness,
          .side = Side::upper,
          .place = in<Number, s, &S::damping_upper>},
      Row{.key = "stop_damping_upper",
          .quantity = damping,
          .range = not_negative,
          .in_machine = {"", "", "", "", "damping coefficient of the upper stop"},
          .role = Role::softness,
          .side = Side::upper,
          .is_with_unit = true,
          .place = at<Number, &Given::stop_damper_upper>},
      Row{.key = "load",
          .quantity = force,
          .range = any,
          .in_scene = {"0", "-0.2", "constant force over stiffness", "", "constant force over stiffness"},
          .in_machine = {"0", "-2 N", "constant force", mass_stops, "constant force"},
          .role = Role::load,
          .place = in<Number, o, &O::load>},
      Row{.key = "stop_amplitude",
          .quantity = length,
          .range = any,
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
          .range = any,
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
          .range = any,
          .in_scene = {"0", "0.5",
                       "lead of the motion of stops or base over the force, rad: they move as amplitude * sin(nu tau + "
                       "phase + stop_phase)",
                       "xs = 1.0\nstop_amplitude = 0.1\n", "lead of the motion of stops or base over the force"},
          .in_machine = {"0", "0.5 rad", "lead of the motion of stops or base over the force",
                         "mass = 0.25\ngap = 3e-3\nfrequency = 25.0\nstop_amplitude = 1e-3\n",
                         "lead of the motion of stops or base over the force"},
          .place = in<Number, k, &K::phase>},
      Row{.key = "x0",
          .quantity = length,
          .range = any,
          .in_scene = {"0", "0.2", "displacement at tau = 0, between the stops", "", "displacement at tau = 0"},
          .in_machine = {"0", "1 mm", "displacement at t = 0, between the stops", mass_stops, "displacement at t = 0"},
          .role = Role::start,
          .place = in<Number, b, &B::displacement>},
      Row{.key = "v0",
          .quantity = velocity,
          .range = any,
          .in_scene = {"0", "-1.5", "velocity at tau = 0", "", "velocity at tau = 0"},
          .in_machine = {"0", "-0.2 m/s", "velocity at t = 0", mass_stops, "velocity at t = 0"},
          .role = Role::start,
          .place = in<Number, b, &B::velocity>},
      Row{.key = "start_period",
          .range = {.low = 0, .high = 2 * std::numbers::pi, .open = true},
          .in_scene = {"", "3",
                       "period of the motion to start on, just after its contact with the lower stop; in place of x0 "
                       "and v0, only if h = f = load = 0, R = 1 and xs is given",
                       stops, "period of the free vibration that the start lies on"},
          .role = Role::start,
          .place = at<Number, &Given::start_period>},
  };
}

}  // namespace scene
}  // namespace clatter
