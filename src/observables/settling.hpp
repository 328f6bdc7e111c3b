#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "motion/event.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// After how many forcing periods the motion has settled. The time before the observed one tells: the point runs it
/// again once the motion is known, and the observer itself sees nothing.
struct Settling {
  static constexpr double settled = 1e-3;  ///< distance from the steady motion, over the larger of its |x| and |v|

  struct Settings {
    bool settling = false;
  };
  struct Values {
    double settling_periods = no_value;  ///< NaN: no steady motion, or not within max_periods
  };
  static constexpr std::string_view observed = "[scene]\nf = 1\n\n[observe]\n";
  static constexpr std::tuple fields{
      Field{with(observed, Key{"observe", "settling", Kind::flag, "false", "true",
                               "forcing periods after which the motion stays within 1e-3 of the steady one"}),
            &Settings::settling}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.settling; }
  [[nodiscard]] static std::string description(const Settings&) { return "settling time"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    return {missing_if(
        "no period is known, there is no force, or max_periods pass before",
        scalar("settling_periods", "forcing periods after which the motion stays within 1e-3 of the steady one",
               &Values::settling_periods))};
  }
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  class Observer;
};

class Settling::Observer {
 public:
  Observer(const Settings&, const ObservedSpan&) {}

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event&) {}
  bool response(const ObservedSpan&, double) { return true; }
  [[nodiscard]] Values finish(const ObservedSpan&, double, double) const { return {}; }
};

}  // namespace clatter::observables
