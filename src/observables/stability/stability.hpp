#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"

namespace clatter::observables {

/// How small changes of a motion grow: the multipliers of a period and the largest Lyapunov exponent, impacts and rests
/// included (eqs. 27 and 28). A motion that grazes a stop to within rounding has none: the smallest change decides
/// whether there is an impact, and after it changes grow as the root of their size.
struct Stability {
  struct Settings {
    bool stability = false;
    bool loose_stability = false;  ///< with it: a loose mass, so that there are four multipliers
  };
  struct Values {
    std::array<double, 4> multiplier_re{no_value, no_value, no_value, no_value};  ///< [multiplier], the larger first
    std::array<double, 4> multiplier_im{no_value, no_value, no_value, no_value};  ///< without a loose mass two
    double lyapunov = no_value;
  };
  static constexpr std::tuple fields{Field{Key{"observe", "stability", Kind::flag, "false", "true",
                                               "multipliers of the periodic motion, largest Lyapunov exponent"},
                                           &Settings::stability}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.stability; }
  [[nodiscard]] static std::string description(const Settings&) { return "stability"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    std::vector<std::int8_t> numbers{1, 2};
    if (settings.loose_stability) numbers = {1, 2, 3, 4};
    const Coordinate multiplier{"multiplier", numbers.size(), numbers,
                                "number of the multiplier, 1: the larger modulus"};
    const auto of = [&](const char* name, const char* long_name, std::array<double, 4> Values::*member) {
      const auto put = [member, count = numbers.size()](const Values& v, double* out) {
        std::copy_n((v.*member).begin(), count, out);
      };
      return Column<Values>{name, long_name, Quantity::number, {multiplier}, put};
    };
    constexpr std::string_view none = "no period is known, or the motion touches a stop within rounding";
    return {missing_if(none, of("multiplier_re", "real part of the period's multipliers", &Values::multiplier_re)),
            missing_if(none, of("multiplier_im", "imaginary part of the period's multipliers", &Values::multiplier_im)),
            missing_if("the motion touches a stop within rounding; -inf if the mass rests in every period",
                       in_si("largest Lyapunov exponent", scalar("lyapunov", "largest Lyapunov exponent per tau",
                                                                 &Values::lyapunov, Quantity::rate)))};
  }

  class Observer;  ///< in stability_observer.hpp
};

}  // namespace clatter::observables
