#pragma once

#include <array>
#include <string_view>

#include "scene/parameter_row.hpp"

namespace clatter {
inline namespace scene {

namespace detail {

constexpr std::string_view in_housing = "f = 0.3\nnu = 1.3\nloose_gap = 1.9\n",
                           housed = "f = 0.3\nnu = 1.3\nloose_mass = 0.05\n",
                           loose_between = "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\n",
                           rubbed = "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_friction = 0.01\n";
constexpr std::string_view machine_in_housing =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_gap = 8e-3\n";
constexpr std::string_view machine_housed =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\n";
constexpr std::string_view machine_loose_between =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n";

constexpr std::string_view machine_rubbed =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n"
    "loose_friction = 0.01\n";

}  // namespace detail

/// The rows of a loose mass: its mass, its walls, and its start.
template <class Number>
constexpr auto loose_rows() {
  using namespace clatter::scene::detail;
  using namespace clatter::scene::ranges;
  using enum Quantity;
  using L = BasicLooseMass<Number>;
  using Row = ParameterRow<Number>;
  constexpr auto l = &BasicScene<Number>::loose;
  return std::array{
      Row{.key = "loose_mass",
          .quantity = mass,
          .range = not_negative,
          .in_scene = {"", "0.05",
                       "mass of a body that lies loose in a housing on the main mass, over the main mass; it moves "
                       "between the walls of the housing, and the main mass feels its impacts; 0: none",
                       in_housing, "loose mass over main mass"},
          .in_machine = {"", "10 g",
                         "mass of a body that lies loose in a housing on the moving mass; it moves between the walls "
                         "of the housing, and the moving mass feels its impacts; 0: none",
                         machine_in_housing, "loose mass"},
          .is_loose = true,
          .place = in<Number, l, &L::ratio>},
      Row{.key = "loose_gap",
          .quantity = length,
          .range = positive,
          .in_scene = {"", "1.9",
                       "walls of the loose mass, at -loose_gap and +loose_gap of its place z = y - x in the housing",
                       housed, "place of the walls"},
          .in_machine = {"", "8 mm",
                         "walls of the loose mass, at -loose_gap and +loose_gap of its place z = y - x in the housing",
                         machine_housed, "place of the walls"},
          .role = Role::position,
          .is_loose = true,
          .place = in<Number, l, &L::lower>,
          .place_of_upper = in<Number, l, &L::upper>},
      Row{.key = "loose_lower",
          .quantity = length,
          .range = any_or_infinite,
          .in_scene = {"-inf", "-1.5", "lower wall of the loose mass, in place of loose_gap; -inf: no wall", housed,
                       "place of the lower wall"},
          .in_machine = {"-inf", "-6 mm", "lower wall of the loose mass, in place of loose_gap; -inf: no wall",
                         machine_housed, "place of the lower wall"},
          .other = "loose_gap",
          .role = Role::position,
          .side = Side::lower,
          .is_loose = true,
          .place = in<Number, l, &L::lower>},
      Row{.key = "loose_upper",
          .quantity = length,
          .range = any_or_infinite,
          .in_scene = {"inf", "2.5", "upper wall of the loose mass, in place of loose_gap; inf: no wall", housed,
                       "place of the upper wall"},
          .in_machine = {"inf", "9 mm", "upper wall of the loose mass, in place of loose_gap; inf: no wall",
                         machine_housed, "place of the upper wall"},
          .other = "loose_gap",
          .role = Role::position,
          .side = Side::upper,
          .is_loose = true,
          .place = in<Number, l, &L::upper>},
      Row{.key = "loose_R",
          .range = zero_to_one,
          .in_scene = {"1", "0.6", "restitution of velocity of the loose mass on both walls", loose_between,
                       "restitution of the loose mass"},
          .in_machine = {"1", "0.6", "restitution of velocity of the loose mass on both walls", machine_loose_between,
                         "restitution of the loose mass"},
          .role = Role::restitution,
          .is_loose = true,
          .place = in<Number, l, &L::restitution_lower>,
          .place_of_upper = in<Number, l, &L::restitution_upper>},
      Row{.key = "loose_R_lower",
          .range = zero_to_one,
          .in_scene = {"1", "0.5", "restitution of the lower wall of the loose mass, in place of loose_R",
                       loose_between, "restitution of the lower wall"},
          .in_machine = {"1", "0.5", "restitution of the lower wall of the loose mass, in place of loose_R",
                         machine_loose_between, "restitution of the lower wall"},
          .other = "loose_R",
          .role = Role::restitution,
          .side = Side::lower,
          .is_loose = true,
          .place = in<Number, l, &L::restitution_lower>},
      Row{.key = "loose_R_upper",
          .range = zero_to_one,
          .in_scene = {"1", "0.5", "restitution of the upper wall of the loose mass, in place of loose_R",
                       loose_between, "restitution of the upper wall"},
          .in_machine = {"1", "0.5", "restitution of the upper wall of the loose mass, in place of loose_R",
                         machine_loose_between, "restitution of the upper wall"},
          .other = "loose_R",
          .role = Role::restitution,
          .side = Side::upper,
          .is_loose = true,
          .place = in<Number, l, &L::restitution_upper>},
      Row{.key = "loose_load",
          .quantity = acceleration,
          .in_scene = {"0", "-0.2", "constant acceleration of the loose mass alone, as by gravity", loose_between,
                       "acceleration of the loose mass"},
          .in_machine = {"0", "-9.81 m/s2", "constant acceleration of the loose mass alone, as by gravity",
                         machine_loose_between, "acceleration of the loose mass"},
          .role = Role::loose_load,
          .is_loose = true,
          .place = in<Number, l, &L::load>},
      Row{.key = "loose_friction",
          .quantity = force,
          .range = not_negative,
          .in_scene = {"0", "0.02",
                       "dry friction of the loose mass on its housing, a force in the unit of f: against z' on the "
                       "loose mass, along it on the main one, and at z' = 0 whatever force makes both move as one, up "
                       "to loose_friction_static",
                       loose_between, "friction of the loose mass"},
          .in_machine = {"0", "20 mN",
                         "dry friction of the loose mass on its housing, a force against its velocity there; at rest "
                         "there whatever force makes both masses move as one, up to loose_friction_static",
                         machine_loose_between, "friction of the loose mass"},
          .role = Role::friction,
          .is_loose = true,
          .place = in<Number, l, &L::friction>},
      Row{.key = "loose_friction_static",
          .quantity = force,
          .range = not_negative,
          .in_scene = {"", "2",
                       "static level of loose_friction, the largest force with which the housing holds the loose mass, "
                       "no less than loose_friction; without this key equal to it",
                       rubbed, "static friction of the loose mass"},
          .in_machine = {"", "2 N",
                         "static level of loose_friction, the largest force with which the housing holds the loose "
                         "mass, no less than loose_friction; without this key equal to it",
                         machine_rubbed, "static friction of the loose mass"},
          .role = Role::friction,
          .is_loose = true,
          .place = in<Number, l, &L::friction_static>},
      Row{.key = "loose_x0",
          .quantity = length,
          .in_scene = {"0", "0.5", "place of the loose mass in the housing at tau = 0, between the walls",
                       loose_between, "place of the loose mass at tau = 0"},
          .in_machine = {"0", "1 mm", "place of the loose mass in the housing at t = 0, between the walls",
                         machine_loose_between, "place of the loose mass at t = 0"},
          .role = Role::start,
          .is_loose = true,
          .place = in<Number, l, &L::place>},
      Row{.key = "loose_v0",
          .quantity = velocity,
          .in_scene = {"0", "0.1", "velocity of the loose mass over the housing at tau = 0", loose_between,
                       "relative velocity of the loose mass at tau = 0"},
          .in_machine = {"0", "5 mm/s", "velocity of the loose mass over the housing at t = 0", machine_loose_between,
                         "relative velocity of the loose mass at t = 0"},
          .role = Role::start,
          .is_loose = true,
          .place = in<Number, l, &L::velocity>},
  };
}

}  // namespace scene
}  // namespace clatter
