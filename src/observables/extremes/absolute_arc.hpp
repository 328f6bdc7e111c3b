#pragma once

#include <algorithm>
#include <cmath>

#include "motion/arc.hpp"
#include "motion/arc_bounds.hpp"
#include "scene/shaking.hpp"
#include "scene/stops.hpp"

namespace clatter::observables {

/// An arc between shaken stops or on a shaken base as the ground sees it: x + b sin(theta), with derivatives and bounds
/// of its own, so that whatever is proved of an arc is proved of it. Between rigid stops to the last bit, which the
/// end of an arc meets only to rounding.
template <class A>
class AbsoluteArc {
 public:
  /// Of an arc that begins a time `begin` after the motion of the frame does.
  AbsoluteArc(const A& arc, const FrameMotion& frame, const Stops& stops, double begin)
      : arc_(arc),
        frame_(frame),
        stops_(outermost(rigid_ones(stops))),
        begin_(begin),
        rate(std::max(arc.constants().rate, frame.frequency())) {}

  [[nodiscard]] motion::Motion<double> start() const { return seen(arc_.start(), 0.0); }
  [[nodiscard]] motion::Motion<double> at(double s) const { return seen(arc_.at(s), s); }

  /// As those of an arc: `jerk`, `rate` and `sixth_bound`.
  [[nodiscard]] const AbsoluteArc& constants() const { return *this; }
  [[nodiscard]] double jerk(const motion::Motion<double>& m) const {
    const SineCosine<double> theta = theta_of(m);
    motion::Motion<double> relative = m;
    relative.v -= frame_.velocity(theta), relative.a -= frame_.acceleration(theta);
    return arc_.constants().jerk(relative) + frame_.jerk(theta);
  }
  /// The relative motion's bound and that of the frame's sine; the free part of a motion is the same in both frames.
  [[nodiscard]] friend double sixth_bound(const AbsoluteArc& arc, const motion::Motion<double>& m, double span,
                                          int derivative) {
    return sixth_bound(arc.arc_.constants(), m, span, derivative) +
           motion::times_sixth_power(arc.size(derivative), arc.frame_.frequency() * span);
  }
  /// Of the frame's displacement (order 0) or velocity (order 1): what the sum of the two motions may cancel.
  [[nodiscard]] double size(int order) const {
    return order == 0 ? frame_.amplitude() : frame_.amplitude() * frame_.frequency();
  }

 private:
  /// Motions keep the phase of the force; without one, theta.
  [[nodiscard]] SineCosine<double> theta_of(const motion::Motion<double>& m) const {
    return frame_.is_forced() ? frame_.by_force(m.sine, m.cosine) : SineCosine<double>{m.sine, m.cosine};
  }
  [[nodiscard]] motion::Motion<double> seen(motion::Motion<double> m, double s) const {
    if (!frame_.is_forced()) {
      const auto [sine, cosine] = frame_.at(begin_ + s);
      m.sine = sine, m.cosine = cosine;
    }
    const SineCosine<double> theta = theta_of(m);
    m.x = std::clamp(m.x, stops_.lower, stops_.upper) + frame_.displacement(theta);
    m.v += frame_.velocity(theta), m.a += frame_.acceleration(theta);
    return m;
  }

  const A& arc_;
  const FrameMotion& frame_;
  Stops stops_;
  double begin_;

 public:
  double rate;  ///< the fastest of the motion's frequencies and decay rates
};

}  // namespace clatter::observables
