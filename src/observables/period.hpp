#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// The period of the motion, and the speed of its first impact.
struct Period {
  struct Settings {
    bool period = false;
  };
  struct Values {
    double period = no_value;          ///< in tau
    double period_ratio = no_value;    ///< in forcing periods; 0: the motion doesn't repeat
    double eigenfrequency = no_value;  ///< 2 pi over the period of unforced motion
    double velocity_ratio = no_value;  ///< |velocity before the first impact / x_s| between symmetric stops
  };
  static constexpr std::tuple fields{Field{
      Key{"observe", "period", Kind::flag, "false", "true", "period of the motion, in tau and in forcing periods"},
      &Settings::period}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.period; }
  [[nodiscard]] static std::string description(const Settings&) { return "period"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    return {
        missing_if("no period is known, or the mass stands still",
                   scalar("period", "period of the motion", &Values::period, Quantity::time)),
        missing_if("it is a transient, stands still, has no force, or rounding would decide; 0 if it doesn't repeat",
                   scalar("period_ratio", "period of the motion in forcing periods", &Values::period_ratio)),
        missing_if("there is a force, no period is known, or the mass stands still",
                   in_si("one over the period of unforced motion",
                         scalar("eigenfrequency", "2 pi over the period of unforced motion", &Values::eigenfrequency,
                                Quantity::frequency))),
        missing_if("no stop is hit, or the stops aren't symmetric",
                   in_relative_frame(scalar("velocity_ratio", "|velocity before impact / xs|", &Values::velocity_ratio,
                                            Quantity::rate)))};
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  class Observer;  ///< in period_observer.hpp
};

}  // namespace clatter::observables
