#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "math/number.hpp"
#include "motion/state.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// The period of the motion, and the speed of its first impact.
class Period {
 public:
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
    return {scalar("period", "period of the motion", &Values::period, Quantity::time),
            scalar("period_ratio", "period of the motion in forcing periods", &Values::period_ratio),
            in_si("one over the period of unforced motion",
                  scalar("eigenfrequency", "2 pi over the period of unforced motion", &Values::eigenfrequency,
                         Quantity::frequency)),
            in_relative_frame(
                scalar("velocity_ratio", "|velocity before impact / xs|", &Values::velocity_ratio, Quantity::rate))};
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  Period(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double length) {
    moves_ = moves_ || length > 0;
  }
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact& impact) {
    if (!(first_speed_ >= 0.0)) first_speed_ = std::abs(impact.before);
  }
  void touch(const motion::Touch& touch) {
    if (!(first_speed_ >= 0.0)) first_speed_ = std::abs(touch.velocity);
  }
  /// Takes over the speed before the first impact, NaN if there is none, of motion that isn't at rest throughout.
  void include(double first_speed) { first_speed_ = first_speed, moves_ = true; }
  bool response(const ObservedSpan&, double) { return include(no_value), true; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    Values values;
    const Stops& stops = span.scene.stops;
    if (stops.lower == -stops.upper) values.velocity_ratio = first_speed_ / stops.upper;
    if (!span.periodic && !span.transient) values.period_ratio = 0.0;
    if (!span.periodic || span.stands_still || !moves_) return values;
    values.period = span.total;
    const bool forced = span.scene.oscillator.forcing != 0;
    if (forced) values.period_ratio = span.turns;
    if (!forced) values.eigenfrequency = 2 * pi<double>() / span.total;
    return values;
  }

 private:
  bool moves_ = false;  ///< the mass isn't at rest throughout
  double first_speed_ = no_value;
};

}  // namespace clatter::observables
