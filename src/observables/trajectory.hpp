#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "observables/observable.hpp"
#include "observables/samples.hpp"

namespace clatter::observables {

/// Displacement and velocity at equally spaced instants of the observed time, both ends included.
class Trajectory {
 public:
  struct Settings {
    std::int64_t trajectory = 0;  ///< samples; 0: none
  };
  struct Values {
    std::vector<double> tau{}, x{}, v{};  ///< shape [sample]
  };
  static constexpr std::tuple fields{Field{Key{"observe",
                                               "trajectory",
                                               Kind::integer,
                                               "0",
                                               "2001",
                                               "samples of tau, x, x' over the observed time; 0: none",
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
    return {of("tau", "time since the beginning of the observed time", &Values::tau, Quantity::time),
            in_observed_frame(of("x", "displacement", &Values::x, Quantity::length)),
            in_observed_frame(of("v", "velocity", &Values::v, Quantity::velocity))};
  }
  [[nodiscard]] static double values_held(const Settings& settings) {
    return 3 * static_cast<double>(settings.trajectory);
  }

  Trajectory(const Settings& settings, const ObservedSpan& span)
      : samples_(count_of(settings), span.total / static_cast<double>(settings.trajectory - 1), AtImpact::after,
                 span.scene.stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    samples_.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) { samples_.rest(rest); }
  void impact(const motion::Impact& impact) { samples_.impact(impact); }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    samples_.finish(x, v, span.total, span.periodic);
    if (span.frame) samples_.add(*span.frame);
    return {samples_.times(span.total), std::move(samples_.displacement()), std::move(samples_.velocity())};
  }
  [[nodiscard]] double evaluations() const { return samples_.evaluations(); }  ///< of arcs

 private:
  [[nodiscard]] static std::size_t count_of(const Settings& settings) {
    return static_cast<std::size_t>(settings.trajectory);
  }

  Samples samples_;
};

}  // namespace clatter::observables
