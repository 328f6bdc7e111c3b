#pragma once

#include <string>
#include <tuple>
#include <vector>

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
                "number of the motion that the start ends in, table of the motions, their shares of the starts"},
            &Settings::attractor}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.attractor; }
  [[nodiscard]] static std::string description(const Settings&) { return "attractors"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&);
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan&) { return true; }

  class Observer;  ///< in attractor_observer.hpp
};

}  // namespace clatter::observables
