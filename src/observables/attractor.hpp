#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "motion/state.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// The state in which a point ends, from which the motions of a whole sweep are told apart and numbered.
struct Attractor {
  struct Settings {
    bool attractor = false;
  };
  struct Values {
    double attractor_x = no_value, attractor_v = no_value;  ///< at the end of the observed time
    double attractor_periods = no_value;  ///< forcing periods after which the motion repeats; 0: none; NaN: not known
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "attractor", Kind::flag, "false", "true",
                "which motion each start settles on, a table of these motions, and their shares of the starts"},
            &Settings::attractor}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.attractor; }
  [[nodiscard]] static std::string description(const Settings&) { return "attractors"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    const auto intermediate = [](const char* name, const char* long_name, double Values::*member) {
      Column<Values> column = scalar(name, long_name, member);
      column.intermediate = true;
      return column;
    };
    return {
        in_relative_frame(intermediate("attractor_x", "displacement in which the point ended", &Values::attractor_x)),
        in_relative_frame(intermediate("attractor_v", "velocity in which the point ended", &Values::attractor_v)),
        intermediate("attractor_periods", "forcing periods after which it repeats, 0: none",
                     &Values::attractor_periods)};
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  class Observer;
};

class Attractor::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact&) {}
  bool response(const ObservedSpan&, double) { return true; }

  /// The end of a period is its beginning. Unforced motion that goes on loses nothing, and is no attractor.
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) const {
    if (span.transient || span.undecided) return {};
    if (span.scene.oscillator.forcing == 0) return span.stands_still ? Values{x, 0.0, 1.0} : Values{};
    return {x, v, span.periodic ? std::round(span.turns) : 0.0};
  }
};

}  // namespace clatter::observables
