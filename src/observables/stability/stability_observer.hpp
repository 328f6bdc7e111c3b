#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>

#include "motion/linear_maps.hpp"
#include "motion/loose_tangent.hpp"
#include "motion/neighbourhood.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/tangent_map.hpp"
#include "observables/stability/rough_grazes.hpp"
#include "observables/stability/stability.hpp"
#include "observables/stability/wall_grazes.hpp"

namespace clatter::observables {

class Stability::Observer {
 public:
  using Complex = std::complex<double>;

  Observer(const Settings&, const ObservedSpan& span)
      : Observer(span.scene.stops, span.uncertainty, pace_of(span.scene.oscillator)) {
    if (has_friction(span.scene.friction)) graze_matters_ = false, rough_.emplace(span.scene, span.uncertainty);
    if (!has_loose_mass(span.scene.loose)) return;
    graze_matters_ = false, rough_.reset(), loose_.emplace(span.scene);
    if (span.periodic) walls_.emplace(span.scene, span.uncertainty);
  }

  /// `rounding` bounds the errors of displacements, and of velocities over the rate `pace`.
  Observer(const Stops& stops, double rounding, double pace = 1)
      : tangent_(stops),
        nearby_(stops, motion::Ellipse::disc(rounding), rounding, true, pace),
        graze_matters_(!has_soft_stop(stops) && !move_by_themselves(stops)) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    ++evaluations_;
    if constexpr (motion::Housed<A>)
      if (walls_) walls_->arc(arc, begin, length);
    if (loose_) return loose_->arc(arc, begin, length);
    tangent_.arc(arc, begin, length);
    if constexpr (motion::Polynomial<A>) {
      graze_matters_ = false, rough_.reset();
    } else {
      if (graze_matters_) nearby_.arc(motion::main_of(arc), begin, length);
      if (rough_) rough_->arc(arc, begin, length);
    }
  }
  void event(const motion::Event& event) {
    if (walls_) walls_->event(event);
    if (loose_) return loose_->event(event);
    tangent_.event(event);
    if (rough_) rough_->event(event);
    rests_ = rests_ || (event.lasts() && !event.is_stick());
    if (event.kind != motion::Event::Kind::impact) return;
    if (graze_matters_) nearby_.event(event);
    if (first_stop_ == Side::none) first_stop_ = event.side;
  }

  /// True if motions that differ from this one by rounding meet other stops. After a rest no difference is left; and
  /// motion by general methods isn't known to rounding. A graze of a soft stop changes little, and beside one those of
  /// a rigid stop aren't told; nor are those of stops that move by themselves. Under dry friction the least speeds and
  /// distances tell them, with rests, too: a mass that friction halts just at a stop may rest there or not.
  [[nodiscard]] bool grazes() const {
    return (graze_matters_ && !rests_ && !nearby_.holds_before(first_stop_)) || (rough_ && rough_->found()) ||
           (walls_ && walls_->found());
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
    if (loose_) return of_loose_mass(span);
    if (span.periodic) {
      finish_period(span.total, !is_driven(span.scene.oscillator) && !span.stands_still);
    } else {
      finish_window(span.total);
    }
    return {{first_.real(), second_.real(), no_value, no_value},
            {first_.imag(), second_.imag(), no_value, no_value},
            exponent_};
  }

  [[nodiscard]] const Complex& first() const { return first_; }    ///< the larger multiplier; NaN without a period
  [[nodiscard]] const Complex& second() const { return second_; }  ///< the smaller one
  [[nodiscard]] double lyapunov() const { return exponent_; }      ///< per tau; -inf if a rest takes every change
  [[nodiscard]] double evaluations() const { return evaluations_; }

 private:
  /// The four multipliers of a motion with a loose mass.
  [[nodiscard]] Values of_loose_mass(const ObservedSpan& span) const {
    Values values;
    const double power = loose_->exponent();
    if (!span.periodic)
      values.lyapunov = (motion::log_norm(loose_->mantissa()) + power * std::numbers::ln2) / span.total;
    if (!span.periodic || grazes()) return values;
    auto all = motion::known_of(motion::multipliers_of(loose_->mantissa()), power);
    std::fill(all.end() - static_cast<std::ptrdiff_t>(loose_->lost()), all.end(), 0.0);  // but for rounding
    values.lyapunov = (std::log(std::abs(all[0])) + power * std::numbers::ln2) / span.total;
    for (std::size_t i = 0; i < all.size(); ++i) {
      values.multiplier_re[i] = motion::TangentMap<double>::scaled(all[i].real(), power) + 0.0;  // no negative zero
      values.multiplier_im[i] = motion::TangentMap<double>::scaled(all[i].imag(), power) + 0.0;
    }
    return values;
  }

  motion::TangentMap<double> tangent_;
  motion::Neighbourhood nearby_;
  std::optional<RoughGrazes> rough_{};           ///< under dry friction, in place of `nearby_`
  std::optional<motion::LooseTangent> loose_{};  ///< with a loose mass, in place of `tangent_`
  std::optional<WallGrazes> walls_{};            ///< of its walls, in place of `nearby_`; if the motion is periodic
  bool graze_matters_, rests_ = false;
  Side first_stop_ = Side::none;  ///< of the first impact, which is that after the end of a period, too
  Complex first_{no_value, no_value}, second_{no_value, no_value};
  double exponent_ = no_value;
  double evaluations_ = 0.0;
};

}  // namespace clatter::observables
