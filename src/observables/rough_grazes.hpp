#pragma once

#include <algorithm>
#include <cmath>

#include "motion/state.hpp"
#include "scene/scene.hpp"

namespace clatter::observables {

/// Tells whether rounding decides, under dry friction, if the motion meets a rigid stop, or sticks where it turns back:
/// then a neighbour goes another way, and the motion has no derivative. At a static level that equals the kinetic one a
/// reversal that just sticks is none of these, since a stick then begins as briefly as one likes.
class RoughGrazes {
 public:
  /// `rounding` bounds the errors of displacements.
  RoughGrazes(const Scene& scene, double rounding)
      : stops_(rigid_ones(scene.stops)),
        friction_(scene.friction),
        rounding_(rounding),
        rounding_of_push_(rounding * (pace_of(scene.oscillator) * pace_of(scene.oscillator) +
                                      std::abs(scene.oscillator.stiffness))) {}

  [[nodiscard]] bool is_sought() const { return has_friction(friction_); }

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto last = arc.at(length);
    acceleration_ = last.a, push_ = last.a - arc.constants().friction;
  }
  /// An impact so slow that the mass would turn back within rounding of the stop.
  void impact(const motion::Impact& impact) {
    const bool brakes = impact.before * acceleration_ < 0;
    if (brakes && impact.before * impact.before <= 2 * std::abs(acceleration_) * rounding_) grazes_ = true;
  }
  /// At a stop if the forces pull it away from there, else it is the crest of a rebound.
  void reversal(const motion::Reversal& reversal) {
    const double x = reversal.position, push = (reversal.before + reversal.after) / 2;
    turn((push > 0 ? x - stops_.lower : stops_.upper - x), push);
  }
  /// Not of one that goes on after a section.
  void rest(const motion::Rest& rest) {
    const bool goes_on = rest.time <= until_ * (1 + 1e-12);
    until_ = rest.time + rest.length;
    if (rest.is_stick() && rest.time > 0 && !goes_on)
      turn(std::min(rest.position - stops_.lower, stops_.upper - rest.position), push_);
  }

  [[nodiscard]] bool found() const { return grazes_; }

 private:
  /// The velocity falls to 0 so far from a stop, under the other forces `push`.
  void turn(double gap, double push) {
    if (gap <= rounding_) grazes_ = true;
    const double left = std::abs(push) - friction_.static_level;
    const bool jumps = friction_.static_level > friction_.kinetic;
    if (jumps && std::abs(left) <= rounding_of_push_) grazes_ = true;
  }

  Stops stops_;
  Friction friction_;
  double rounding_, rounding_of_push_;      ///< of displacements, of the other forces
  double acceleration_ = 0.0, push_ = 0.0;  ///< at the end of the last arc; the second without friction
  double until_ = -1.0;                     ///< end of the last stick
  bool grazes_ = false;
};

}  // namespace clatter::observables
