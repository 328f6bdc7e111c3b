#pragma once

#include <algorithm>
#include <cmath>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "motion/relative_arc.hpp"
#include "scene/scene.hpp"

namespace clatter::observables {

/// Tells whether rounding decides if a loose mass meets a rigid wall: it strikes the wall so slowly that it would turn
/// back within rounding of it, or it does turn back there. And whether it decides which comes first, that or a contact
/// of the main mass with a stop.
class WallGrazes {
 public:
  /// `rounding` bounds the errors of displacements.
  WallGrazes(const Scene& scene, double rounding)
      : walls_(rigid_ones(walls_of(scene.loose))),
        inner_{.lower = walls_.lower + rounding, .upper = walls_.upper - rounding},
        stops_{.lower = scene.stops.lower, .upper = scene.stops.upper},
        rounding_(rounding) {}

  /// Of the arc of a main mass, what the loose one does meanwhile.
  template <motion::Housed A>
  void arc(const A& arc, double, double length) {
    look_at(arc.loose, length);
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind == Kind::strike && event.before * event.before <= 2 * std::abs(turning_) * rounding_) grazes_ = true;
    if (event.kind == Kind::press) grazes_ = false;  // chatter, whose impacts are as slow as they like, is forgotten
    if (event.kind == Kind::strike && comes_to(stops_, main_)) grazes_ = true;
    if ((event.kind == Kind::impact || event.kind == Kind::touch) && comes_to(walls_, loose_)) grazes_ = true;
  }

  [[nodiscard]] bool found() const { return grazes_; }

 private:
  /// Looks for a contact with walls that are moved inwards by rounding, well clear of the walls that the flight leaves
  /// and meets, so that the errors of its two ends and of the search count for nothing. A flight that doesn't come
  /// clear of them meets no other wall.
  template <Effects E>
  void look_at(const motion::RelativeArc<double, E>& arc, double length) {
    const motion::Motion<double> first = arc.start(), last = arc.at(length);
    turning_ = last.a, loose_ = last, main_ = arc.main_at(last);
    const double begin = time_near(first, arc.constants().jerk(arc.main_at(first)), 1),
                 end = length - time_near(last, arc.constants().jerk(arc.main_at(last)), -1);
    if (!(begin < end && is_clear(arc.at(end)))) return;
    const motion::RelativeArc<double, E> middle = arc.from(begin);
    if (is_clear(middle.start()) && motion::next_contact(middle, inner_, end - begin).side != Side::none)
      grazes_ = true;
  }
  /// Motion by a general method isn't known to rounding.
  template <motion::Polynomial A>
  void look_at(const A& arc, double length) {
    turning_ = arc.at(length).a;
  }
  void look_at(const motion::Pressed&, double) { loose_ = main_ = {}; }

  /// Whether a mass is at a stop, or a wall, to rounding, and comes to it faster than that.
  [[nodiscard]] bool comes_to(const Stops& places, const motion::Motion<double>& m) const {
    const double gap = m.v > 0 ? places.upper - m.x : m.x - places.lower;
    return std::abs(gap) <= rounding_ && m.v * m.v > 2 * std::abs(m.a) * rounding_;
  }

  [[nodiscard]] bool is_clear(const motion::Motion<double>& m) const {
    return m.x > inner_.lower && m.x < inner_.upper;
  }
  /// How long the flight is near a wall, forwards or backwards in time: until its speed, its acceleration or its rate
  /// has taken it many times as far as rounding. A section may cut a flight anywhere, just beside the inner walls, too.
  [[nodiscard]] double time_near(const motion::Motion<double>& m, double jerk, double forwards) const {
    const double clear = 64 * rounding_;
    if (m.x > inner_.lower + clear && m.x < inner_.upper - clear) return 0.0;
    const double inwards = m.x >= inner_.upper - clear ? -1 : 1;
    const auto lead = [&](double rate) { return std::max(0.0, inwards * rate); };
    return std::min({2 * clear / lead(forwards * m.v), std::sqrt(4 * clear / lead(m.a)),
                     std::cbrt(12 * clear / lead(-forwards * jerk))});
  }

  Stops walls_, inner_, stops_;
  double rounding_;
  motion::Motion<double> loose_{}, main_{};  ///< at the end of the flight
  double turning_ = 0.0;                     ///< z'' at the end of the flight
  bool grazes_ = false;
};

}  // namespace clatter::observables
