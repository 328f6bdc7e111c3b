#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"
#include "scene/parameter.hpp"

namespace clatter::observables {

/// Derivatives of results of periodic motion under a force by numbers that the user gives, in the user's units: how
/// much a tolerance of each matters. They are exact, as those of branches are. Motion that grazes a stop to within
/// rounding has none, nor has motion without a period, or with a loose mass that strikes no wall.
struct Sensitivity {
  struct Settings {
    ParameterSet sensitivity{};      ///< the keys by which derivatives are taken
    bool loose_sensitivity = false;  ///< with it: a loose mass, so that its extrema have derivatives, too
  };
  /// Derivatives by one key; those of impact speeds are NaN on a stop, or a wall, without impacts.
  struct ByKey {
    double x_min = no_value, x_max = no_value;  ///< in the observed frame
    double period = no_value;
    std::array<double, 2> impact_speed{no_value, no_value};  ///< [stop]
    double impact_power = no_value;                          ///< per unit mass
    double y_min = no_value, y_max = no_value;               ///< of a loose mass, in the observed frame
    double z_min = no_value, z_max = no_value;               ///< of its place in the housing
  };
  struct Values {
    std::vector<ByKey> sensitivities{};  ///< [key]; empty: all are NaN
  };
  static constexpr std::tuple fields{Field{
      Key{"observe", "sensitivity", Kind::names, "", "R",
          "keys of the scene, e.g. R, stiffness: derivatives of x_min, x_max, period, impact_speed and impact_power of "
          "periodic motion by each of them; of a loose mass those of y_min, y_max, z_min and z_max, too"},
      &Settings::sensitivity}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return !settings.sensitivity.empty(); }
  [[nodiscard]] static std::string description(const Settings& settings) {
    std::string keys;
    for (const Parameter key : settings.sensitivity.list()) keys.append(keys.empty() ? "" : ", ").append(key.key());
    return "derivatives by " + keys;
  }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings);

  class Observer;  ///< in sensitivity_observer.hpp
};

}  // namespace clatter::observables
