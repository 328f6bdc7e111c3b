#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// The states of a motion at one forcing phase in successive periods, its stroboscopic (Poincaré) section; without
/// forcing, its states as it passes the load's equilibrium upward. Of periodic motion these are the states of one
/// period, of a transient those before its end.
struct Section {
  struct Settings {
    std::int64_t section = 0;    ///< states; 0: none
    double section_phase = 0.0;  ///< of the force, rad
    bool loose_section = false;  ///< with it: that of a loose mass
  };
  struct Values {
    std::vector<double> section_x{}, section_v{};  ///< shape [section]
    std::vector<double> section_z{}, section_w{};  ///< shape [section]: place of a loose mass in its housing, and z'
  };
  static constexpr std::string_view observed = "[scene]\nf = 1\n\n[observe]\nsection = 500\n";
  static constexpr std::tuple fields{
      Field{Key{"observe",
                "section",
                Kind::integer,
                "0",
                "500",
                "number of successive forcing periods whose state is sampled at section_phase (Poincare section); 0: "
                "none",
                {.low = 0, .high = 1e7}},
            &Settings::section},
      Field{with(observed, of(Quantity::angle, Key{"observe", "section_phase", Kind::number, "0", "1.5708",
                                                   "forcing phase of these states, in rad"})),
            &Settings::section_phase}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.section > 0; }
  [[nodiscard]] static std::string description(const Settings& settings) {
    return "section of " + std::to_string(settings.section) + " states";
  }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings);
  [[nodiscard]] static double values_held(const Settings& settings, int points) {
    return points * (settings.loose_section ? 4 : 2) * static_cast<double>(settings.section);
  }
  /// Lanes report their states at the forcing phase of the start, and follow no motion beyond the observed time.
  [[nodiscard]] static bool in_lanes(const Settings& settings, const ObservedSpan& span);
  /// From the forcing phase of the start to another one, in turns, 0 ... 1.
  [[nodiscard]] static double turns_to(double phase, const Scene& scene);

  class Observer;  ///< in section_observer.hpp
};

}  // namespace clatter::observables
