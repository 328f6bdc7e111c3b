#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// Displacement and velocity at equally spaced instants of the observed time, both ends included.
struct Trajectory {
  struct Settings {
    std::int64_t trajectory = 0;    ///< samples; 0: none
    bool loose_trajectory = false;  ///< with it: that of a loose mass
  };
  struct Values {
    std::vector<double> tau{}, x{}, v{};  ///< shape [sample]
    std::vector<double> z{}, w{};         ///< shape [sample]: place of a loose mass in its housing, and z'
  };
  static constexpr std::tuple fields{
      Field{Key{"observe",
                "trajectory",
                Kind::integer,
                "0",
                "2001",
                "number of samples of time, x and x' over the observed time, with a loose "
                "mass of its place z and of z', too; 0: none",
                {.low = 2, .high = 1e7, .or_zero = true}},
            &Settings::trajectory}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.trajectory > 0; }
  [[nodiscard]] static std::string description(const Settings& settings) {
    return "trajectory of " + std::to_string(settings.trajectory) + " samples";
  }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    const auto of = [&](const char* name, const char* long_name, std::vector<double> Values::*member,
                        Quantity quantity) {
      return series<Values>(name, long_name, quantity, {"sample", count_of(settings)},
                            [member](const Values& v) -> const std::vector<double>& { return v.*member; });
    };
    std::vector<Column<Values>> all{
        of("tau", "time since the beginning of the observed time", &Values::tau, Quantity::time),
        in_observed_frame(of("x", "displacement", &Values::x, Quantity::length)),
        in_observed_frame(of("v", "velocity", &Values::v, Quantity::velocity))};
    if (!settings.loose_trajectory) return all;
    all.push_back(of("z", "place of the loose mass in the housing", &Values::z, Quantity::length));
    all.push_back(of("w", "velocity of the loose mass over the housing", &Values::w, Quantity::velocity));
    return all;
  }
  /// Of the samples.
  [[nodiscard]] static std::size_t count_of(const Settings& settings) {
    return static_cast<std::size_t>(settings.trajectory);
  }
  [[nodiscard]] static double values_held(const Settings& settings, int points) {
    return points * (settings.loose_trajectory ? 5 : 3) * static_cast<double>(settings.trajectory);
  }

  class Observer;  ///< in trajectory_observer.hpp
};

}  // namespace clatter::observables
