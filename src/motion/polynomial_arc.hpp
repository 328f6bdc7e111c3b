#pragma once

#include <cmath>

#include "math/bernstein.hpp"
#include "motion/arc_constants.hpp"

namespace clatter::motion {

/// Motion without impact as a general method gives it between the steps of its mesh: displacement and velocity by a
/// polynomial each. Observers take it in place of an Arc.
template <Effects E>
class PolynomialArc {
 public:
  using Number = double;

  /// `rise` above the anchor and `velocity` over a step of length `length` that begins at a forcing phase, in turns.
  PolynomialArc(const ArcConstants<double, E>& constants, double anchor, double turns, double length,
                const Bernstein<double>& offset, const Bernstein<double>& velocity)
      : constants_(&constants), anchor_(anchor), turns_(turns), length_(length), rise_(offset), velocity_(velocity) {}

  [[nodiscard]] const ArcConstants<double, E>& constants() const { return *constants_; }
  [[nodiscard]] Motion<double> start() const { return at(0.0); }
  [[nodiscard]] double anchor() const { return anchor_; }                        ///< the place that `rise` counts from
  [[nodiscard]] double length() const { return length_; }                        ///< of the step, in tau
  [[nodiscard]] const Bernstein<double>& offset() const { return rise_; }        ///< over the step
  [[nodiscard]] const Bernstein<double>& velocity() const { return velocity_; }  ///< over the step

  /// Motion a time s after the start, 0 <= s <= length; the acceleration is the equation's there.
  [[nodiscard]] Motion<double> at(double s) const {
    const double u = length_ > 0 ? s / length_ : 0.0;
    const double offset = value_at(rise_, u), v = value_at(velocity_, u), x = anchor_ + offset;
    const auto [sine, cosine] = phase_after(s);
    return {offset, x,     v, constants_->acceleration(constants_->from_equilibrium(x, anchor_, offset), v, sine),
            sine,   cosine};
  }

  /// The forcing phase a time s after the start.
  [[nodiscard]] SineCosine<double> phase_after(double s) const {
    return sine_cosine_of_turns(turns_ + s / constants_->period);
  }

 private:
  const ArcConstants<double, E>* constants_;
  double anchor_, turns_, length_;
  Bernstein<double> rise_, velocity_;
};

/// Whether arcs are given by polynomials.
template <class A>
concept Polynomial = requires(const A& arc) {
  arc.offset(), arc.velocity();
};

}  // namespace clatter::motion
