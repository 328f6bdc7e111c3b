#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "motion/neighbourhood.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/tangent_map.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// How small changes of a motion grow: the multipliers of a period and the largest Lyapunov exponent, impacts and rests
/// included (eqs. 27 and 28). A motion that grazes a stop to within rounding has none: the smallest change decides
/// whether there is an impact, and after it changes grow as the root of their size.
class Stability {
 public:
  using Complex = std::complex<double>;

  struct Settings {
    bool stability = false;
  };
  struct Values {
    std::array<double, 2> multiplier_re{no_value, no_value};  ///< [multiplier], the larger first
    std::array<double, 2> multiplier_im{no_value, no_value};
    double lyapunov = no_value;
  };
  static constexpr std::tuple fields{Field{Key{"observe", "stability", Kind::flag, "false", "true",
                                               "multipliers of the periodic motion, largest Lyapunov exponent"},
                                           &Settings::stability}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.stability; }
  [[nodiscard]] static std::string description(const Settings&) { return "stability"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&) {
    const Coordinate multiplier{"multiplier", 2, std::vector<std::int8_t>{1, 2},
                                "number of the multiplier, 1: the larger modulus"};
    return {pair("multiplier_re", "real part of the period's multipliers", multiplier, &Values::multiplier_re),
            pair("multiplier_im", "imaginary part of the period's multipliers", multiplier, &Values::multiplier_im),
            in_si("largest Lyapunov exponent",
                  scalar("lyapunov", "largest Lyapunov exponent per tau", &Values::lyapunov, Quantity::rate))};
  }

  Stability(const Settings&, const ObservedSpan& span) : Stability(span.scene.stops, span.uncertainty) {}

  /// `rounding` bounds the errors of displacements and velocities.
  Stability(const Stops& stops, double rounding)
      : tangent_(stops),
        nearby_(stops, motion::Ellipse::disc(rounding), rounding),
        graze_matters_(!has_soft_stop(stops)) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    tangent_.arc(arc, begin, length);
    ++evaluations_;
    if constexpr (motion::Polynomial<A>) {
      graze_matters_ = false;
    } else {
      if (graze_matters_) nearby_.arc(arc, begin, length);
    }
  }
  void rest(const motion::Rest& rest) { tangent_.rest(rest), rests_ = true; }
  void impact(const motion::Impact& impact) {
    tangent_.impact(impact);
    if (graze_matters_) nearby_.impact(impact);
  }
  void touch(const motion::Touch& touch) { tangent_.touch(touch); }

  /// True if motions that differ from this one by rounding meet other stops. After a rest no difference is left; and
  /// motion by general methods isn't known to rounding. A graze of a soft stop changes little, and beside one those of
  /// a rigid stop aren't told.
  [[nodiscard]] bool grazes() const { return graze_matters_ && !rests_ && !nearby_.holds(); }

  /// Ends the observed time, one period. Unforced motion (`autonomous`) is periodic only when it loses nothing; a shift
  /// of time along it, and one to a neighbouring speed, stay what they are: both multipliers are 1.
  void finish_period(double total, bool autonomous) {
    if (autonomous) {
      first_ = second_ = 1.0, exponent_ = 0.0;
      return;
    }
    if (grazes()) return;
    const motion::Jacobian<double> map = tangent_.mantissa();
    const double product = tangent_.mantissa_determinant(), half = (map[0] + map[3]) / 2,
                 square = half * half - product;
    first_ = square < 0 ? Complex(half, std::sqrt(-square)) : half + std::copysign(std::sqrt(square), half);
    second_ = square < 0 ? std::conj(first_) : first_ == 0.0 ? first_ : product / first_;
    exponent_ = (std::log(std::abs(first_)) + tangent_.exponent() * std::numbers::ln2) / total;
    for (Complex* const multiplier : {&first_, &second_})
      *multiplier = {
          motion::TangentMap<double>::scaled(multiplier->real(), tangent_.exponent()),
          motion::TangentMap<double>::scaled(multiplier->imag(), tangent_.exponent()) + 0.0};  // no negative zero
  }

  /// Ends the observed time of motion without a period: the exponent along it.
  void finish_window(double total) { exponent_ = tangent_.log_norm() / total; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) {
    if (span.periodic) {
      finish_period(span.total, span.scene.oscillator.forcing == 0 && !span.stands_still);
    } else {
      finish_window(span.total);
    }
    return {{first_.real(), second_.real()}, {first_.imag(), second_.imag()}, exponent_};
  }

  [[nodiscard]] const Complex& first() const { return first_; }    ///< the larger multiplier; NaN without a period
  [[nodiscard]] const Complex& second() const { return second_; }  ///< the smaller one
  [[nodiscard]] double lyapunov() const { return exponent_; }      ///< per tau; -inf if a rest takes every change
  [[nodiscard]] double evaluations() const { return evaluations_; }

 private:
  motion::TangentMap<double> tangent_;
  motion::Neighbourhood nearby_;
  bool graze_matters_, rests_ = false;
  Complex first_{no_value, no_value}, second_{no_value, no_value};
  double exponent_ = no_value;
  double evaluations_ = 0.0;
};

}  // namespace clatter::observables
