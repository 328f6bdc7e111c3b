#pragma once

#include "math/bernstein.hpp"
#include "motion/arc_constants.hpp"

namespace clatter::motion {

/// Motion without impact over one step of a general method, with a polynomial each for displacement and velocity.
/// Observers take it in place of an Arc.
template <Effects E>
class PolynomialArc {
 public:
  using Number = double;
  static constexpr Effects effects = E;

  /// `offset` from the anchor and `velocity` over a step of length `length` that begins at the forcing phase `turns`,
  /// in turns.
  PolynomialArc(const ArcConstants<double, E>& constants, double anchor, double turns, double length,
                const Bernstein<double>& offset, const Bernstein<double>& velocity)
      : constants_(&constants), anchor_(anchor), turns_(turns), length_(length), offset_(offset), velocity_(velocity) {}

  [[nodiscard]] const ArcConstants<double, E>& constants() const { return *constants_; }
  [[nodiscard]] Motion<double> start() const { return at(0.0); }
  [[nodiscard]] double anchor() const { return anchor_; }                    ///< the position that `offset` counts from
  [[nodiscard]] double length() const { return length_; }                    ///< of the step, in tau
  [[nodiscard]] const Bernstein<double>& offset() const { return offset_; }  ///< over the step
  [[nodiscard]] const Bernstein<double>& velocity() const { return velocity_; }  ///< over the step

  /// Motion a time s after the start, 0 <= s <= length, with the acceleration of eq. 3.
  [[nodiscard]] Motion<double> at(double s) const {
    const double u = share(s), offset = value_at(offset_, u), v = value_at(velocity_, u), x = anchor_ + offset;
    const SineCosine<double> phase = phase_after(s);
    const double a = constants_->acceleration(constants_->from_equilibrium(x, anchor_, offset), v, phase);
    return {offset, x, v, a, phase.sine, phase.cosine};
  }

  /// Displacement alone.
  [[nodiscard]] double displacement(double s) const { return anchor_ + value_at(offset_, share(s)); }

  /// The forcing phase a time s after the start.
  [[nodiscard]] SineCosine<double> phase_after(double s) const {
    if (constants_->is_in_pieces()) return constants_->phase_after(constants_->phase_at(turns_), s);
    return sine_cosine_of_turns(turns_ + s / constants_->period);
  }

 private:
  [[nodiscard]] double share(double s) const { return length_ > 0 ? s / length_ : 0.0; }

  const ArcConstants<double, E>* constants_;
  double anchor_, turns_, length_;
  Bernstein<double> offset_, velocity_;
};

/// An arc that is given by polynomials.
template <class A>
concept Polynomial = requires(const A& arc) {
  arc.offset(), arc.velocity();
};

}  // namespace clatter::motion
