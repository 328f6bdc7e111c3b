#pragma once

#include <algorithm>
#include <cmath>

#include "motion/event.hpp"
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
  void event(const motion::Event& event) {
    if (event.kind == motion::Event::Kind::impact) strike(event.before);
    if (event.kind == motion::Event::Kind::reversal) turn_back(event.place, (event.a_before + event.a_after) / 2);
    if (event.lasts()) stay(event);
  }

  [[nodiscard]] bool found() const { return grazes_; }

 private:
  /// An impact so slow that the mass would turn back within rounding of the stop.
  void strike(double v) {
    const bool brakes = v * acceleration_ < 0;
    if (brakes && v * v <= 2 * std::abs(acceleration_) * rounding_) grazes_ = true;
  }
  /// At a stop if the forces pull it away from there, else it is the crest of a rebound.
  void turn_back(double x, double push) { turn((push > 0 ? x - stops_.lower : stops_.upper - x), push); }
  /// Not of a stick that goes on after a section.
  void stay(const motion::Event& rest) {
    const bool goes_on = rest.time <= until_ * (1 + 1e-12);
    until_ = rest.end();
    if (rest.is_stick() && rest.time > 0 && !goes_on)
      turn(std::min(rest.place - stops_.lower, stops_.upper - rest.place), push_);
  }
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
