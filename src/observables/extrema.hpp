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
  };
  struct Values {
    double x_min = no_value, x_max = no_value, v_min = no_value, v_max = no_value;
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "extrema", Kind::flag, "false", "true",
                "exact extrema of displacement and velocity: x_min, x_max, v_min, v_max"},
            &Settings::extrema}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.extrema; }
  [[nodiscard]] static std::string description(const Settings&) { return "extrema"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    return {in_observed_frame(scalar("x_min", "minimum displacement", &Values::x_min, Quantity::length)),
            in_observed_frame(scalar("x_max", "maximum displacement", &Values::x_max, Quantity::length)),
            in_observed_frame(scalar("v_min", "minimum velocity", &Values::v_min, Quantity::velocity)),
            in_observed_frame(scalar("v_max", "maximum velocity", &Values::v_max, Quantity::velocity))};
  }
  /// Lanes know the relative motion.
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan& span) { return !span.frame; }

  class Observer;  ///< in extrema_observer.hpp
};

}  // namespace clatter::observables
