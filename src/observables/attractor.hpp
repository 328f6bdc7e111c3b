#pragma once

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "motion/event.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// The state in which a point ends, from which the motions of a whole sweep are told apart and numbered.
struct Attractor {
  struct Settings {
    bool attractor = false;
    bool loose_attractor = false;     ///< with it: the state of a loose mass
    bool followed_attractor = false;  ///< with it: the phase, which along `follow` is that of the points before
  };
  struct Values {
    double attractor_x = no_value, attractor_v = no_value;  ///< at the end of the observed time
    double attractor_periods = no_value;  ///< forcing periods after which the motion repeats; 0: none; NaN: not known
    double attractor_z = no_value, attractor_w = no_value;  ///< of a loose mass, then; the point sets them
    double attractor_phase = no_value;                      ///< of the force as the scene gives it, then, rad
  };
  static constexpr std::tuple fields{
      Field{Key{"observe", "attractor", Kind::flag, "false", "true",
                "which motion each start settles on, a table of these motions, and their shares of the starts"},
            &Settings::attractor}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.attractor; }
  [[nodiscard]] static std::string description(const Settings&) { return "attractors"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    const auto intermediate = [](const char* name, const char* long_name, double Values::*member) {
      Column<Values> column = scalar(name, long_name, member);
      column.intermediate = true;
      return column;
    };
    std::vector<Column<Values>> all{
        in_relative_frame(intermediate("attractor_x", "displacement in which the point ended", &Values::attractor_x)),
        in_relative_frame(intermediate("attractor_v", "velocity in which the point ended", &Values::attractor_v)),
        intermediate("attractor_periods", "forcing periods after which it repeats, 0: none",
                     &Values::attractor_periods)};
    if (settings.followed_attractor)
      all.push_back(
          intermediate("attractor_phase", "forcing phase in which the point ended", &Values::attractor_phase));
    if (!settings.loose_attractor) return all;
    all.push_back(intermediate("attractor_z", "place of the loose mass in the housing in which the point ended",
                               &Values::attractor_z));
    all.push_back(intermediate("attractor_w", "velocity of the loose mass over the housing in which the point ended",
                               &Values::attractor_w));
    return all;
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  class Observer;
};

class Attractor::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event&) {}
  bool response(const ObservedSpan&, double) { return true; }

  /// The end of a period is its beginning. Unforced motion that goes on loses nothing, and is no attractor.
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) const {
    if (span.transient || span.undecided) return {};
    if (!is_driven(span.scene.oscillator) && !span.stands_still) return {};
    Values values{
        .attractor_x = x, .attractor_v = v, .attractor_periods = span.periodic ? std::round(span.turns) : 0.0};
    if (!is_driven(span.scene.oscillator)) values.attractor_v = 0.0, values.attractor_periods = 1.0;
    values.attractor_phase = span.theta;  // after whole periods that of the beginning
    return values;
  }
};

}  // namespace clatter::observables
