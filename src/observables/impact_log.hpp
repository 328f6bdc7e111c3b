#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "motion/state.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// Keeps every impact. As many as there are, they have no column: results hold them one point after the other.
struct ImpactLog {
  struct Settings {
    bool impact_log = false;
    bool full_log = false;  ///< with it: every rest and completed chatter, and an impact at the beginning itself
  };
  struct Values {
    std::vector<motion::Impact> log{};
    std::vector<motion::Rest> rests{};
  };
  static constexpr std::tuple fields{Field{
      Key{"observe", "impact_log", Kind::flag, "false", "true", "log of every observed impact: time, stop, velocities"},
      &Settings::impact_log}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.impact_log || settings.full_log; }
  [[nodiscard]] static std::string description(const Settings&) { return "impact log"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) { return {}; }

  class Observer;  ///< in impact_log_observer.hpp
};

}  // namespace clatter::observables
