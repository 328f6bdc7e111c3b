#include "config/machine_keys.hpp"

#include <array>

namespace clatter::config {
namespace {

constexpr Kind numeric = Kind::number;

constexpr AllowedRange any{};
constexpr AllowedRange any_or_infinite{.infinite = true};
constexpr AllowedRange not_negative{.low = 0};
constexpr AllowedRange positive{.low = 0, .open = true};
constexpr AllowedRange positive_or_infinite{.low = 0, .open = true, .infinite = true};
constexpr AllowedRange zero_to_one{.low = 0, .high = 1};

constexpr std::string_view some_mass = "mass = 0.25\n", stops = "gap = 3e-3\n",
                           mass_stops = "mass = 0.25\ngap = 3e-3\n",
                           soft = "mass = 0.25\ngap = 3e-3\nstop_stiffness = 1e5\n",
                           mass_spring_stops = "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\n",
                           mass_stops_frequency = "mass = 0.25\ngap = 3e-3\nfrequency = 25.0\n",
                           mass_stops_force = "mass = 0.25\ngap = 3e-3\nforce = 40.0\n",
                           forced = "mass = 0.25\ngap = 3e-3\nforce = 40.0\nfrequency = 25.0\n";

/// A damping ratio, or with a unit a damping.
constexpr Key stop_damper(Key key) { return or_with_unit(Quantity::damping, key); }

constexpr std::array keys{
    with(stops, of(Quantity::mass, Key{"machine", "mass", numeric, "", "250 g", "the mass that moves", positive})),
    with(mass_stops, of(Quantity::stiffness, Key{"machine", "stiffness", numeric, "0", "800 N/m",
                                                 "of the spring; 0: none, negative: pushes away from x = 0", any})),
    with(mass_stops, of(Quantity::damping, Key{"machine", "damping", numeric, "0", "1.5 N s/m",
                                               "force of the damper over the velocity", not_negative})),
    with(mass_spring_stops,
         Key{"machine", "damping_ratio", numeric, "", "0.05",
             "damping over 2 (|stiffness| mass)^(1/2), in place of damping; needs a spring", not_negative}),
    with(mass_spring_stops,
         Key{"machine", "quality", numeric, "", "10",
             "(|stiffness| mass)^(1/2) over the damping, in place of damping; needs a spring", positive}),
    with(mass_stops_frequency, of(Quantity::force, Key{"machine", "force", numeric, "0", "40 N",
                                                       "force amplitude; negative: a phase shift of pi", any})),
    with(mass_stops_force,
         of(Quantity::frequency, Key{"machine", "frequency", numeric, "", "25 Hz",
                                     "of the force, and of stops or a base that move, which need it; numbers without "
                                     "unit are in Hz, and rad/s is converted",
                                     positive})),
    with(forced, of(Quantity::angle, Key{"machine", "phase", numeric, "0", "0.5 rad",
                                         "phase of the force at t = 0; pi/2: a cosine", any})),
    with(mass_stops, Key{"machine", "R", numeric, "1", "0.7", "restitution of velocity on both stops", zero_to_one}),
    with(some_mass, of(Quantity::length,
                       Key{"machine", "gap", numeric, "", "3 mm", "symmetric stops at -gap and +gap", positive})),
    with(some_mass,
         or_as("gap", of(Quantity::length, Key{"machine", "stop_lower", numeric, "-inf", "-2 mm",
                                               "lower stop, in place of gap; -inf: none", any_or_infinite}))),
    with(some_mass, or_as("gap", of(Quantity::length, Key{"machine", "stop_upper", numeric, "inf", "4 mm",
                                                          "upper stop, in place of gap; inf: none", any_or_infinite}))),
    with(mass_stops, or_as("R", Key{"machine", "R_lower", numeric, "1", "0.5",
                                    "restitution of the lower stop, in place of R", zero_to_one})),
    with(mass_stops, or_as("R", Key{"machine", "R_upper", numeric, "1", "0.5",
                                    "restitution of the upper stop, in place of R", zero_to_one})),
    with(mass_stops,
         of(Quantity::stiffness, Key{"machine", "stop_stiffness", numeric, "inf", "100 N/mm",
                                     "of both stops, in place of R; inf: rigid. A soft stop pushes with that times the "
                                     "depth beyond it plus damping, and never pulls",
                                     positive_or_infinite})),
    with(mass_stops,
         or_as("stop_stiffness",
               of(Quantity::stiffness, Key{"machine", "stop_stiffness_lower", numeric, "inf", "90 N/m",
                                           "of the lower stop, in place of stop_stiffness", positive_or_infinite}))),
    with(mass_stops,
         or_as("stop_stiffness",
               of(Quantity::stiffness, Key{"machine", "stop_stiffness_upper", numeric, "inf", "90 N/m",
                                           "of the upper stop, in place of stop_stiffness", positive_or_infinite}))),
    with(soft, stop_damper(Key{"machine", "stop_damping", numeric, "0", "0.1",
                               "damping ratio of both soft stops, damping over 2 (stop_stiffness mass)^(1/2); with a "
                               "unit, as 40 N s/m, the damping",
                               not_negative})),
    with(soft,
         or_as("stop_damping", stop_damper(Key{"machine", "stop_damping_lower", numeric, "0", "0.1",
                                               "of the lower soft stop, in place of stop_damping", not_negative}))),
    with(soft,
         or_as("stop_damping", stop_damper(Key{"machine", "stop_damping_upper", numeric, "0", "0.1",
                                               "of the upper soft stop, in place of stop_damping", not_negative}))),
    with(mass_stops, of(Quantity::force, Key{"machine", "load", numeric, "0", "-2 N", "constant force", any})),
    with(mass_stops_frequency,
         of(Quantity::length, Key{"machine", "stop_amplitude", numeric, "0", "1 mm",
                                  "both stops move as that times the sine of the forcing phase; displacements, x0, v0 "
                                  "and impact speeds are relative to them",
                                  any})),
    with(mass_stops_frequency,
         of(Quantity::length, Key{"machine", "base_amplitude", numeric, "0", "1 mm",
                                  "the base, and with it the stops, moves as that times the sine of the forcing phase; "
                                  "displacements, x0, v0 and impact speeds are relative to it",
                                  any})),
    with(mass_stops, of(Quantity::length,
                        Key{"machine", "x0", numeric, "0", "1 mm", "displacement at t = 0, between the stops", any})),
    with(mass_stops, of(Quantity::velocity, Key{"machine", "v0", numeric, "0", "-0.2 m/s", "velocity at t = 0", any})),
};

}  // namespace

std::span<const Key> machine_keys() { return keys; }

}  // namespace clatter::config
