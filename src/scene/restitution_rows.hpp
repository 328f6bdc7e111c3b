#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "scene/parameter_row.hpp"

namespace clatter {
inline namespace scene {

namespace detail {

/// A key of the restitution by speed of both stops, with those of each.
struct RestitutionKeys {
  std::array<std::string_view, 3> keys;  ///< of both, of the lower one, of the upper one
  Quantity quantity;
  AllowedRange range;
  std::string_view fallback, in_scene, in_machine;  ///< its default and its examples
  std::array<std::string_view, 3> help, long_name;
  std::array<std::string_view, 2> beside;  ///< in [scene] and [machine]
  bool is_loose;
};

/// Their rows.
template <class Number, auto part, auto lower, auto upper, auto member>
constexpr std::array<ParameterRow<Number>, 3> rows_of(const RestitutionKeys& of) {
  std::array<ParameterRow<Number>, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = {.key = of.keys[i],
               .quantity = of.quantity,
               .range = of.range,
               .in_scene = {of.fallback, of.in_scene, of.help[i], of.beside[0], of.long_name[i]},
               .in_machine = {of.fallback, of.in_machine, of.help[i], of.beside[1], of.long_name[i]},
               .other = i == 0 ? std::string_view{} : of.keys[0],
               .role = Role::law_of_speed,
               .side = i == 0   ? Side::none
                       : i == 1 ? Side::lower
                                : Side::upper,
               .is_loose = of.is_loose,
               .place = i == 2 ? of_law<Number, part, upper, member> : of_law<Number, part, lower, member>,
               .place_of_upper = i == 0 ? of_law<Number, part, upper, member> : nullptr};
  }
  return rows;
}

inline constexpr AllowedRange zero_to_below_one{.low = 0, .high = 1, .open = true, .or_zero = true};

constexpr std::string_view exponent_stops = "xs = 1.0\nR = 0.7\nR_reference_speed = 1.0\n",
                           reference_stops = "xs = 1.0\nR = 0.7\nR_exponent = 0.2\n",
                           below_stops = "xs = 1.0\nR = 0.7\n";
constexpr std::string_view machine_exponent_stops =
    "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nR = 0.7\nR_reference_speed = 0.5\n";
constexpr std::string_view machine_reference_stops =
    "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nR = 0.7\nR_exponent = 0.2\n";
constexpr std::string_view machine_below_stops = "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nR = 0.7\n";
constexpr std::string_view loose_exponent =
                               "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\n"
                               "loose_R_reference_speed = 1.0\n",
                           loose_reference =
                               "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\n"
                               "loose_R_exponent = 0.2\n",
                           loose_below = "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\n";
constexpr std::string_view machine_loose_exponent =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n"
    "loose_R = 0.6\nloose_R_reference_speed = 0.5\n";
constexpr std::string_view machine_loose_reference =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n"
    "loose_R = 0.6\nloose_R_exponent = 0.2\n";
constexpr std::string_view machine_loose_below =
    "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n"
    "loose_R = 0.6\n";

}  // namespace detail

/// The rows of restitution by speed (eq. 86) of the stops, by key.
template <class Number>
constexpr auto restitution_rows() {
  using namespace clatter::scene::detail;
  using R = Restitution<Number>;
  using S = BasicStops<Number>;
  constexpr auto s = &BasicScene<Number>::stops;
  constexpr auto lower = &S::restitution_lower, upper = &S::restitution_upper;
  return joined(
      rows_of<Number, s, lower, upper, &R::exponent>(
          {.keys = {"R_exponent", "R_exponent_lower", "R_exponent_upper"},
           .quantity = Quantity::number,
           .range = zero_to_below_one,
           .fallback = "0",
           .in_scene = "0.2",
           .in_machine = "0.2",
           .help = {"exponent p of a restitution that falls with the impact speed v, 1 - (1 - R) (v/V)^p with V = "
                    "R_reference_speed, down to p/(1 + p), then constant; 0.2 is that of viscoelastic spheres; 0: R "
                    "at every speed",
                    "exponent p of the lower stop, in place of R_exponent",
                    "exponent p of the upper stop, in place of R_exponent"},
           .long_name = {"exponent of the restitution", "exponent of the lower restitution",
                         "exponent of the upper restitution"},
           .beside = {exponent_stops, machine_exponent_stops},
           .is_loose = false}),
      rows_of<Number, s, lower, upper, &R::reference>(
          {.keys = {"R_reference_speed", "R_reference_speed_lower", "R_reference_speed_upper"},
           .quantity = Quantity::velocity,
           .range = ranges::positive,
           .fallback = "",
           .in_scene = "1",
           .in_machine = "0.5 m/s",
           .help = {"impact speed V at which the restitution is R; only with R_exponent",
                    "speed V of the lower stop, in place of R_reference_speed",
                    "speed V of the upper stop, in place of R_reference_speed"},
           .long_name = {"reference speed of the restitution", "reference speed of the lower restitution",
                         "reference speed of the upper restitution"},
           .beside = {reference_stops, machine_reference_stops},
           .is_loose = false}),
      rows_of<Number, s, lower, upper, &R::below>(
          {.keys = {"R_below", "R_below_lower", "R_below_upper"},
           .quantity = Quantity::velocity,
           .range = ranges::not_negative,
           .fallback = "0",
           .in_scene = "0.01",
           .in_machine = "1 cm/s",
           .help = {"impact speed below which the mass doesn't rebound", "that of the lower stop, in place of R_below",
                    "that of the upper stop, in place of R_below"},
           .long_name = {"least speed of a rebound", "least speed of a rebound, lower stop",
                         "least speed of a rebound, upper stop"},
           .beside = {below_stops, machine_below_stops},
           .is_loose = false}));
}

/// Those of the walls of a loose mass.
template <class Number>
constexpr auto loose_restitution_rows() {
  using namespace clatter::scene::detail;
  using R = Restitution<Number>;
  using L = BasicLooseMass<Number>;
  constexpr auto l = &BasicScene<Number>::loose;
  constexpr auto lower = &L::restitution_lower, upper = &L::restitution_upper;
  return joined(
      rows_of<Number, l, lower, upper, &R::exponent>(
          {.keys = {"loose_R_exponent", "loose_R_exponent_lower", "loose_R_exponent_upper"},
           .quantity = Quantity::number,
           .range = zero_to_below_one,
           .fallback = "0",
           .in_scene = "0.2",
           .in_machine = "0.2",
           .help = {"exponent p of a restitution of the loose mass that falls with the speed v of its impact, "
                    "1 - (1 - loose_R) (v/V)^p with V = loose_R_reference_speed, down to p/(1 + p), then constant; 0: "
                    "loose_R at every speed",
                    "exponent p of the lower wall, in place of loose_R_exponent",
                    "exponent p of the upper wall, in place of loose_R_exponent"},
           .long_name = {"exponent of the restitution of the loose mass", "exponent of the restitution, lower wall",
                         "exponent of the restitution, upper wall"},
           .beside = {loose_exponent, machine_loose_exponent},
           .is_loose = true}),
      rows_of<Number, l, lower, upper, &R::reference>(
          {.keys = {"loose_R_reference_speed", "loose_R_reference_speed_lower", "loose_R_reference_speed_upper"},
           .quantity = Quantity::velocity,
           .range = ranges::positive,
           .fallback = "",
           .in_scene = "1",
           .in_machine = "0.5 m/s",
           .help = {"speed V in the housing at which the restitution is loose_R; only with loose_R_exponent",
                    "speed V of the lower wall, in place of loose_R_reference_speed",
                    "speed V of the upper wall, in place of loose_R_reference_speed"},
           .long_name = {"reference speed of the restitution of the loose mass",
                         "reference speed of the restitution, lower wall",
                         "reference speed of the restitution, upper wall"},
           .beside = {loose_reference, machine_loose_reference},
           .is_loose = true}),
      rows_of<Number, l, lower, upper, &R::below>(
          {.keys = {"loose_R_below", "loose_R_below_lower", "loose_R_below_upper"},
           .quantity = Quantity::velocity,
           .range = ranges::not_negative,
           .fallback = "0",
           .in_scene = "0.01",
           .in_machine = "1 cm/s",
           .help = {"speed in the housing below which the loose mass doesn't rebound",
                    "that of the lower wall, in place of loose_R_below",
                    "that of the upper wall, in place of loose_R_below"},
           .long_name = {"least speed of a rebound of the loose mass", "least speed of a rebound, lower wall",
                         "least speed of a rebound, upper wall"},
           .beside = {loose_below, machine_loose_below},
           .is_loose = true}));
}

}  // namespace scene
}  // namespace clatter
