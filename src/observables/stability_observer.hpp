#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "motion/neighbourhood.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/tangent_map.hpp"
#include "observables/rough_grazes.hpp"
#include "observables/stability.hpp"

namespace clatter::observables {

class Stability::Observer {
 public:
  using Complex = std::complex<double>;

  Observer(const Settings&, const ObservedSpan& span) : Observer(span.scene.stops, span.uncertainty) {
    if (has_friction(span.scene.friction)) graze_matters_ = false, rough_.emplace(span.scene, span.uncertainty);
  }

  /// `rounding` bounds the errors of displacements and velocities.
  Observer(const Stops& stops, double rounding)
      : tangent_(stops),
        nearby_(stops, motion::Ellipse::disc(rounding), rounding),
        graze_matters_(!has_soft_stop(stops)) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    tangent_.arc(arc, begin, length);
    ++evaluations_;
    if constexpr (motion::Polynomial<A>) {
      graze_matters_ = false, rough_.reset();
    } else {
      if (graze_matters_) nearby_.arc(arc, begin, length);
      if (rough_) rough_->arc(arc, begin, length);
    }
  }
  void rest(const motion::Rest& rest) {
    tangent_.rest(rest), rests_ = rests_ || !rest.is_stick();
    if (rough_) rough_->rest(rest);
  }
  void reversal(const motion::Reversal& reversal) {
    tangent_.reversal(reversal);
    if (rough_) rough_->reversal(reversal);
  }
  void impact(const motion::Impact& impact) {
    tangent_.impact(impact);
    if (graze_matters_) nearby_.impact(impact);
    if (rough_) rough_->impact(impact);
  }
  void touch(const motion::Touch& touch) { tangent_.touch(touch); }

  /// True if motions that differ from this one by rounding meet other stops. After a rest no difference is left; and
  /// motion by general methods isn't known to rounding. A graze of a soft stop changes little, and beside one those of
  /// a rigid stop aren't told. Under dry friction the least speeds and distances tell them.
  [[nodiscard]] bool grazes() const {
    return !rests_ && ((graze_matters_ && !nearby_.holds()) || (rough_ && rough_->found()));
  }

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
          motion::TangentMap<double>::scaled(multiplier->real(), tangent_.exponent()) + 0.0,  // no negative zero
          motion::TangentMap<double>::scaled(multiplier->imag(), tangent_.exponent()) + 0.0};
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
  std::optional<RoughGrazes> rough_{};  ///< under dry friction, in place of `nearby_`
  bool graze_matters_, rests_ = false;
  Complex first_{no_value, no_value}, second_{no_value, no_value};
  double exponent_ = no_value;
  double evaluations_ = 0.0;
};

}  // namespace clatter::observables
