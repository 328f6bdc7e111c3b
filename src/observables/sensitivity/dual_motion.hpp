#pragma once

#include <array>
#include <cmath>

#include "motion/arc.hpp"
#include "motion/event.hpp"
#include "motion/soft_stop.hpp"
#include "observables/energy/quadrature.hpp"
#include "observables/observable.hpp"
#include "observables/sensitivity/course.hpp"
#include "observables/sensitivity/dual_force.hpp"

namespace clatter::observables {

// Motions on numbers that carry derivatives: their values are those of a run, and their phases are those of the force,
// of which only the derivatives count.

/// A number whose derivatives are those of another one.
template <class Along>
[[nodiscard]] Along with_slope_of(double value, const Along& other) {
  Along number = other;
  number.value = value;
  return number;
}

/// Sine and cosine of the force at the start of a stretch, or s and ds/dtheta of one in pieces, at a phase of which
/// only the derivatives count.
template <class Along>
[[nodiscard]] SineCosine<Along> force_at(const Stretch& stretch, const DualForce<Along>& pieces, const Along& phase) {
  const motion::Motion<double>& m = stretch.start;
  if (!pieces.is_in_pieces()) return {m.cosine * phase, -m.sine * phase};
  return pieces.at(stretch, phase);
}

/// The start of a stretch as it was run, with the derivatives of a state and a force.
template <class Along, Effects E>
[[nodiscard]] motion::Motion<Along> with_slopes_of(const Stretch& stretch, const Along& x_at, const Along& v_at,
                                                   const SineCosine<Along>& force,
                                                   const motion::ArcConstants<Along, E>& constants) {
  const motion::Motion<double>& m = stretch.start;
  const Along x = with_slope_of(m.x, x_at), offset = with_slope_of(m.offset, x_at), v = with_slope_of(m.v, v_at),
              sine = with_slope_of(m.sine, force.sine), cosine = with_slope_of(m.cosine, force.cosine);
  const Along a =
      constants.acceleration(constants.from_equilibrium(x, Along(stretch.anchor), offset), v, {sine, cosine});
  return {offset, x, v, with_slope_of(m.a, a), sine, cosine};
}

template <class Along>
[[nodiscard]] const Along& position_of(const BasicStops<Along>& stops, Side side) {
  return side == Side::upper ? stops.upper : stops.lower;
}

/// By how much an event of the main mass comes later, of a motion that has arrived at it along an arc: its surface
/// (eqs. 4 and 50; of a slip the velocity) over the rate of change. Its value is 0; it is NaN of an event without a
/// surface.
template <class Along>
[[nodiscard]] Along lateness_of(const motion::Event& event, const motion::Motion<Along>& end, double anchor,
                                const BasicStops<Along>& stops) {
  using Kind = motion::Event::Kind;
  const auto over = [](const Along& surface, double rate) { return with_slope_of(0, -surface / rate); };
  const auto beyond = [&] { return end.offset + anchor - position_of(stops, event.side); };
  switch (event.kind) {
    case Kind::impact:
    case Kind::touch:
      return over(beyond(), end.v.value);
    case Kind::renewal:
    case Kind::separation: {
      const Along relaxation = motion::soft_stop_at<Along>(stops, event.side).relaxation();
      return over(beyond() + relaxation * end.v, end.v.value + relaxation.value * end.a.value);
    }
    case Kind::reversal:
    case Kind::stick:
      return over(end.v, end.a.value);
    default:
      return Along(no_value);
  }
}

/// The integral of the squared velocity along an arc, whose end comes later by `late`.
template <class Along, Effects E>
[[nodiscard]] Along squares_of_velocity(const motion::Arc<Along, E>& arc, double length,
                                        const motion::Motion<Along>& end, const Along& late) {
  Along squares = end.v * end.v * late;
  over_panels<20>(length, pace_of(arc.constants()), 2, [&](double s, double weight) {
    const Along v = arc.at(Along(s)).v;
    squares += weight * v * v;
  });
  return squares;
}

/// The greatest speed of contacts on each stop or wall; NaN of one that is not met.
template <class Along>
class FastestContacts {
 public:
  void see(Side side, const Along& velocity) {
    const Along speed = abs(velocity);
    Along& fastest = of_side_[index_of(side)];
    if (!(fastest.value >= speed.value)) fastest = speed;
  }
  [[nodiscard]] const Along& of(Side side) const { return of_side_[index_of(side)]; }

 private:
  [[nodiscard]] static Along none() {
    Along none(no_value);
    none.slope.fill(no_value);
    return none;
  }
  std::array<Along, 2> of_side_{none(), none()};
};

/// The energy that the springs of soft stops hold, of a mass at x.
template <class Along>
[[nodiscard]] Along stored_by_soft_stops(const BasicStops<Along>& stops, const Along& x) {
  Along stored = 0;
  for (const Side side : {Side::lower, Side::upper}) {
    if (!is_soft(stops, side)) continue;
    const auto stop = motion::soft_stop_at<Along>(stops, side);
    const Along depth = stop.into(x - stop.position);
    if (depth.value > 0) stored += stop.stiffness * depth * depth / 2;
  }
  return stored;
}

/// The observed frame, in which displacements have the motion of what is shaken beyond the computed one, or less.
template <class Along>
class DualFrame {
 public:
  /// Displacement, velocity and acceleration.
  struct Observed {
    Along x, v, a;
  };

  /// Of a scene whose force leads by `lead`.
  DualFrame(const ObservedSpan& span, const BasicScene<Along>& scene, const Along& lead)
      : b_(span.frame_sign * (scene.shaking.stops + scene.shaking.base)),
        nu_(scene.oscillator.frequency),
        lead_(lead),
        phase_(scene.shaking.phase),
        moves_(!is_always_zero(b_)),
        frame_(span.scene.shaking, span.scene.oscillator, span.theta) {}

  /// That of the frame, from sine and cosine of its phase, and the derivative of that.
  [[nodiscard]] Observed at(const Along& sine, const Along& cosine, const Along& phase) const {
    const Along moved_sine = sine + cosine * phase, moved_cosine = cosine - sine * phase;
    return {b_ * moved_sine, b_ * nu_ * moved_cosine, -b_ * nu_ * nu_ * moved_sine};
  }
  /// A computed motion in the frame, at a phase of the force.
  [[nodiscard]] Observed observed(const motion::Motion<Along>& m, const Along& phase) const {
    if (!moves_) return {m.x, m.v, m.a};
    const auto [sine, cosine] = frame_.by_force(m.sine.value, m.cosine.value);
    const Observed frame = at(sine, cosine, with_slope_of(0, phase - lead_ + phase_));
    return {m.x + frame.x, m.v + frame.v, m.a + frame.a};
  }
  [[nodiscard]] Along displacement(const motion::Motion<Along>& m, const Along& phase) const {
    return observed(m, phase).x;
  }
  [[nodiscard]] Along turning_point(const motion::Motion<Along>& m, const Along& phase) const {
    const auto [x, v, a] = observed(m, phase);
    return turning_point(x, v, a);
  }
  /// The search stops a little beside a turning point; to first order the displacement there is x - v^2/(2 a).
  [[nodiscard]] static Along turning_point(const Along& x, const Along& v, const Along& a) {
    const Along beyond = -v * v / (2 * a);
    return std::abs(beyond.value) <= 1e-6 * std::abs(x.value) ? x + beyond : x;
  }

 private:
  Along b_, nu_;
  Along lead_, phase_;  ///< of the force, and of what is shaken
  bool moves_;
  FrameMotion frame_;
};

}  // namespace clatter::observables
