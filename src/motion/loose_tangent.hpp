#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "motion/event.hpp"
#include "motion/linear_maps.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "motion/walls.hpp"

namespace clatter::motion {

/// The derivative of a motion with a loose mass with respect to its start: free motion of both masses over the arcs,
/// and at each event S = D + (f+ - D f-) grad g / (grad g . f-), with the flows f- and f+ before and after it, the
/// derivative D of the state after, and the guard g that it falls to 0 of (eq. 73 is that of an impact on a wall;
/// Nordmark 1991). A press keeps nothing of z and z', a rest nothing of x and x'. It is kept times a power of two, so
/// that nothing overflows.
class LooseTangent {
 public:
  explicit LooseTangent(const Scene& scene) : stops_(scene.stops), loose_(scene.loose), rule_(loose_) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto& constants = arc.constants();
    const auto start = arc.start();
    settle(start.a, constants.carried != 0 ? start.a : loose_.load);
    const bool is_held = constants.h == 0 && constants.k == 0 && constants.f == 0 && constants.load == 0;
    if (sticks_ && !is_held) release(start, constants.spring(1.0) / (constants.f * constants.nu * start.cosine));
    const auto p = constants.propagator(length);
    const Row x = combined(p.a, map_[0], p.b, map_[1]), v = combined(-constants.spring(p.b), map_[0], p.c, map_[1]);
    map_[0] = x, map_[1] = v;
    carried_ = constants.carried;
    if (carried_ != 0)
      move_with_main(), loses_two_ = true;
    else
      map_[2] = combined(1, map_[2], length, map_[3]);
    h_ = constants.h, k_ = constants.spring(1.0), friction_ = constants.friction;
    force_ = constants.force(arc.phase_after(length).sine);
    rescale();
  }
  void event(const Event& event) {
    switch (event.kind) {
      case Event::Kind::impact:
        return impact(event);
      case Event::Kind::touch:
        return touch(event);
      case Event::Kind::reversal:
        return reverse(event);
      case Event::Kind::rest:
      case Event::Kind::chatter:
        return rest();
      case Event::Kind::stick:
        return stick();
      case Event::Kind::strike:
        return strike(event.before, event.main);
      case Event::Kind::press:
        return press();
      default:
        return;
    }
  }

  /// Makes the map that from here on, between an arc and the event at its end, too.
  void begin_anew() { map_ = identity, exponent_ = 0, late_ = {}; }

  [[nodiscard]] LooseJacobian map() const {
    LooseJacobian map = map_;
    for (Row& row : map)
      for (double& entry : row) entry *= std::exp2(exponent_);
    return map;
  }
  /// The map without its power of two.
  [[nodiscard]] const LooseJacobian& mantissa() const { return map_; }
  [[nodiscard]] double exponent() const { return exponent_; }  ///< of two, a whole number
  /// Whether a press or a rest has left no more than two numbers of a change.
  [[nodiscard]] bool loses_two() const { return loses_two_; }

 private:
  using Row = Four<double>;
  static constexpr LooseJacobian identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  /// The acceleration of the main mass at a place and a velocity, where the last arc ends.
  [[nodiscard]] double acceleration(double x, double v) const { return force_ - k_ * x - 2 * h_ * v; }
  /// The same alone, when the loose mass that it has carried goes on by itself.
  [[nodiscard]] double acceleration_alone(double x, double v, double friction) const {
    return (1 + carried_) * (acceleration(x, v) - friction) - carried_ * loose_.load;
  }
  void move_with_main() { map_[2] = map_[0], map_[3] = map_[1]; }

  /// An event that comes the later by `late` for each small change, after which the accelerations are supposed to be
  /// these; the next arc knows them.
  void expect(const Row& late, double a, double a_loose) { late_ = late, a_ = a, a_loose_ = a_loose; }
  void settle(double a, double a_loose) {
    if (differ(a_, a)) add(map_[1], a_ - a, late_);
    if (differ(a_loose_, a_loose)) add(map_[3], a_loose_ - a_loose, late_);
    late_ = {};
  }
  /// By more than rounding.
  [[nodiscard]] static bool differ(double a, double b) {
    return std::abs(a - b) > 64 * epsilon<double>() * (std::abs(a) + std::abs(b));
  }

  /// An impact on a rigid stop, at which a loose mass that a wall pressed goes on.
  void impact(const Event& e) {
    if (e.before == 0) return;
    const Restitution<double> law = restitution_at<double>(stops_, e.side);
    const double a = acceleration(e.place, e.before), slope = law.derivative(e.before),
                 a_after = acceleration_alone(e.place, e.after, 2 * friction_);
    const Row late = combined(-1 / e.before, map_[0], 0, map_[0]);
    if (carried_ != 0) add(map_[3], a - loose_.load, late);
    map_[0] = combined(e.after / e.before, map_[0], 0, map_[0]);
    map_[1] = combined(slope, map_[1], slope * a - a_after, late);
    expect(late, a_after, loose_.load);
    carried_ = 0, rescale();
  }
  /// The damper of a soft stop pushes from the touch on (eq. 53).
  void touch(const Event& e) {
    const double push = 2 * soft_stop_at<double>(stops_, e.side).damping / (1 + carried_) * e.before;
    const double a_after = acceleration(e.place, e.before) - push;
    const Row late = combined(-1 / e.before, map_[0], 0, map_[0]);
    add(map_[1], push, late);
    if (carried_ != 0) map_[3] = map_[1];
    expect(late, a_after, carried_ != 0 ? a_after : loose_.load);
  }
  /// The acceleration jumps where the velocity is 0 (eq. 64).
  void reverse(const Event& e) {
    const Row late = combined(-1 / e.a_before, map_[1], 0, map_[1]);
    map_[1] = combined(e.a_after / e.a_before, map_[1], 0, map_[1]);
    if (carried_ != 0) map_[3] = map_[1];
    expect(late, e.a_after, carried_ != 0 ? e.a_after : loose_.load);
  }
  void rest() {
    map_[0] = map_[1] = {};
    if (carried_ != 0) move_with_main();
    loses_two_ = true, sticks_ = false, late_ = {};
  }
  void stick() {
    map_[1] = {};
    if (carried_ != 0) map_[3] = {};
    sticks_ = true, late_ = {};
  }
  /// A stick ends the later the further the spring has to be overcome (eq. 65).
  void release(const Motion<double>& start, double later) {
    sticks_ = false;
    if (start.a == 0) return;
    add(map_[1], -start.a * later, map_[0]);
    if (carried_ != 0) map_[3] = map_[1];
  }
  /// An impact on a wall with z' = w.
  void strike(double w, const Event::Main& main) {
    if (w == 0) return;
    const double a = acceleration(main.place, main.before), a_after = acceleration(main.place, main.after),
                 towards = loose_.load - a;
    const double kick = -rule_.share() * rule_.law_for(w).jump(1.0), back = kick / rule_.ratio;  // of x' and -y' by z'
    const Row z = combined(1, map_[2], -1, map_[0]), dw = combined(1, map_[3], -1, map_[1]);
    add(map_[0], kick, z);
    add(map_[1], kick, dw), add(map_[1], (a_after - a - kick * towards) / w, z);
    add(map_[2], -back, z);
    add(map_[3], -back, dw), add(map_[3], back * towards / w, z);
    expect(combined(-1 / w, z, 0, z), a_after, loose_.load);
    sticks_ = false, rescale();
  }
  /// Both masses keep their common centre and momentum.
  void press() {
    const double share = rule_.share();
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
      map_[i] = map_[i + 2] = combined(1 - share, map_[i], share, map_[i + 2]);
    a_ = a_loose_ = (1 - share) * a_ + share * a_loose_, carried_ = rule_.ratio, loses_two_ = true;
  }

  [[nodiscard]] static Row combined(double a, const Row& one, double b, const Row& other) {
    Row sum;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = a * one[i] + b * other[i];
    return sum;
  }
  static void add(Row& row, double factor, const Row& other) { row = combined(1, row, factor, other); }

  void rescale() {
    double size = 0;
    for (const Row& row : map_)
      for (const double entry : row) size = std::max(size, std::abs(entry));
    const int shift = size > 0x1p200 ? -200 : size > 0 && size < 0x1p-200 ? 200 : 0;
    if (shift == 0) return;
    for (Row* const row : {&map_[0], &map_[1], &map_[2], &map_[3], &late_})
      for (double& entry : *row) entry = std::ldexp(entry, shift);
    exponent_ -= shift;
  }

  Stops stops_;
  LooseMass loose_;
  WallRule<double> rule_;
  LooseJacobian map_ = identity;
  double exponent_ = 0;
  bool loses_two_ = false;
  bool sticks_ = false;         ///< friction has held the main mass since
  Row late_{};                  ///< by which the last event is late, until the next arc begins,
  double a_ = 0, a_loose_ = 0;  ///< and the accelerations after it
  double h_ = 0, k_ = 1;        ///< damping and stiffness of the last arc,
  double force_ = 0;            ///< the force on the main mass at x = 0 at its end,
  double friction_ = 0;         ///< of which so much is friction,
  double carried_ = 0;          ///< and the loose mass, if a wall presses it
};

}  // namespace clatter::motion
