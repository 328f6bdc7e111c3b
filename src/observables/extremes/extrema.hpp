#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// Least and greatest displacement and velocity, between the ends of arcs too: every stretch of an arc is either proved
/// not to exceed the extrema found so far, by the enclosure that finds contacts (eq. 13), or split, at its turning
/// point if it has one. An arc without length takes no time, so the speed of a start into a stop doesn't count.
struct Extrema {
  struct Settings {
    bool extrema = false;
    bool loose_extrema = false;  ///< with it: those of a loose mass
  };
  struct Values {
    double x_min = no_value, x_max = no_value, v_min = no_value, v_max = no_value;
    double y_min = no_value, y_max = no_value, z_min = no_value, z_max = no_value;  ///< of a loose mass
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "extrema", Kind::flag, "false", "true",
                "exact extrema of displacement and velocity: x_min, x_max, v_min, v_max; of a loose mass "
                "those of its displacement y and of its place z in the housing"},
            &Settings::extrema}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.extrema; }
  [[nodiscard]] static std::string description(const Settings&) { return "extrema"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    std::vector<Column<Values>> all{
        in_observed_frame(scalar("x_min", "minimum displacement", &Values::x_min, Quantity::length)),
        in_observed_frame(scalar("x_max", "maximum displacement", &Values::x_max, Quantity::length)),
        in_observed_frame(scalar("v_min", "minimum velocity", &Values::v_min, Quantity::velocity)),
        in_observed_frame(scalar("v_max", "maximum velocity", &Values::v_max, Quantity::velocity))};
    if (!settings.loose_extrema) return all;
    const auto add = [&](const char* name, const char* long_name, double Values::*member) {
      all.push_back(scalar(name, long_name, member, Quantity::length));
    };
    add("y_min", "minimum displacement of the loose mass", &Values::y_min), all.back() = in_observed_frame(all.back());
    add("y_max", "maximum displacement of the loose mass", &Values::y_max), all.back() = in_observed_frame(all.back());
    add("z_min", "minimum place of the loose mass in the housing", &Values::z_min);
    add("z_max", "maximum place of the loose mass in the housing", &Values::z_max);
    return all;
  }
  /// Lanes know the relative motion.
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan& span) { return !span.frame; }

  class Observer;  ///< in extrema_observer.hpp
};

}  // namespace clatter::observables
