#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "motion/state.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// Counts impacts and sums the time at rest, for each stop.
class Impacts {
 public:
  struct Settings {
    bool impacts = false;
  };
  struct Values {
    std::array<double, 2> impacts_per_period{no_value, no_value};  ///< [stop]
    std::array<double, 2> v_before{no_value, no_value}, v_after{no_value, no_value};
    std::array<double, 2> rest_fraction{no_value, no_value};
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "impacts", Kind::flag, "false", "true",
                "per stop: impacts per period, velocity before and after the first, share of time at rest"},
            &Settings::impacts}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.impacts; }
  [[nodiscard]] static std::string description(const Settings&) { return "impacts"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    const Coordinate stop = stop_coordinate();
    return {pair("impacts_per_period", "impacts per forcing period", stop, &Values::impacts_per_period),
            in_relative_frame(
                pair("v_before", "velocity before the first impact", stop, &Values::v_before, Quantity::velocity)),
            in_relative_frame(
                pair("v_after", "velocity after the first impact", stop, &Values::v_after, Quantity::velocity)),
            pair("rest_fraction", "share of time at rest on the stop", stop, &Values::rest_fraction)};
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  struct OfStop {
    double count = 0.0;
    double before = no_value;  ///< velocity before the first impact, signed
    double after = no_value;   ///< velocity after it
    double rest_time = 0.0;    ///< in tau
  };

  Impacts() = default;
  Impacts(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest& rest) {
    if (rest.held) stops_[index_of(rest.side)].rest_time += rest.length;
  }
  void impact(const motion::Impact& impact) {
    OfStop& stop = stops_[index_of(impact.side)];
    if (stop.count == 0.0) stop.before = impact.before, stop.after = impact.after;
    stop.count += 1.0;
  }
  /// Takes over what was counted elsewhere, in motion that never rests.
  void include(const std::array<OfStop, 2>& stops) { stops_ = stops; }
  /// The response meets no stop.
  bool response(const ObservedSpan&, double) { return true; }

  [[nodiscard]] const std::array<OfStop, 2>& stops() const { return stops_; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    const double periods = span.counts_as_one_period() ? 1.0 : span.turns;
    Values values;
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      values.impacts_per_period[i] = stops_[i].count / periods;
      values.v_before[i] = stops_[i].before, values.v_after[i] = stops_[i].after;
      values.rest_fraction[i] = std::min(1.0, stops_[i].rest_time / span.total);
    }
    return values;
  }

 private:
  std::array<OfStop, 2> stops_{};
};

}  // namespace clatter::observables
