#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motion/coupled_arc.hpp"
#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/linear_maps.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "motion/walls.hpp"

namespace clatter::motion {

/// The derivative of a motion with a loose mass with respect to its start: free motion of both masses over the arcs,
/// and at each event S = D + (f+ - D f-) grad g / (grad g . f-), with the flows f- and f+ before and after it, the
/// derivative D of the state after, and the guard g that it falls to 0 of (eq. 73 is that of an impact on a wall;
/// Nordmark 1991). A press keeps nothing of z and z', a stick in the housing nothing of z', a rest nothing of x and x'.
/// Where friction in the housing stops the loose mass, or lets it go, no event tells so, but two arcs that differ; the
/// velocities go on there, so that D = 1. It is kept times a power of two, so that nothing overflows.
class LooseTangent {
 public:
  explicit LooseTangent(const Scene& scene)
      : stops_(scene.stops), loose_(scene.loose), rule_(loose_), is_rough_(has_loose_friction(loose_)) {}

  /// The law of a wall.
  [[nodiscard]] const Restitution<double>& law(Side wall) const { return rule_.law(wall); }

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto& constants = arc.constants();
    const auto start = arc.start();
    const bool carries = constants.carried != 0;
    const bool is_held = constants.h == 0 && constants.k == 0 && constants.f == 0 && constants.load == 0;
    const double load = load_on(arc), a_loose = carries ? start.a : loose_acceleration(arc, 0.0);
    const bool jumps =
        constants.is_in_pieces() && std::abs(start.sine - end_.sine) > 1e-6;  // of a table hardly ever less
    if (is_rough_ && !std::exchange(is_told_, false) && !jumps) change_hold(carries, load, is_held);
    settle(start.a, a_loose);
    if (sticks_ && !is_held)
      release(start.a, a_loose,
              constants.is_let_go_by_jump(start)
                  ? 0.0
                  : constants.spring(1.0) / (constants.f * constants.nu * constants.drive(start).cosine));
    if constexpr (Housed<A>) on_wall_ = wall_of(arc.loose) != Side::none;
    const Row place = place_in_housing();
    flow(arc, length);
    carried_ = constants.carried, load_ = load, begun_ = true;
    held_ = held_in(arc);
    alone_ = carries ? load - held_.push / rule_.ratio : loose_acceleration(arc, length);
    if (carried_ != 0) move_with_main(place), lose(on_wall_ ? 2 : 1);
    h_ = constants.h, k_ = constants.spring(1.0), friction_ = constants.friction;
    force_ = constants.force(arc.phase_after(length)) + push_on(arc, length);
    if (is_rough_) note_end(arc, length, is_held);
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
        return stick(event);
      case Event::Kind::strike:
        return strike(event.before, event.main);
      case Event::Kind::wall_touch:
        return touch_wall(event.before, event.main);
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
  /// How many numbers of a change are lost at least: by a press or a rest two, by a stick in the housing one.
  [[nodiscard]] std::size_t lost() const { return lost_; }

 private:
  using Row = Four<double>;
  static constexpr LooseJacobian identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  /// The acceleration of the main mass at a place and a velocity, where the last arc ends.
  [[nodiscard]] double acceleration(double x, double v) const { return force_ - k_ * x - 2 * h_ * v; }
  /// The same alone, when the loose mass that it has carried goes on by itself.
  [[nodiscard]] double acceleration_alone(double x, double v, double friction) const {
    return (1 + carried_) * (acceleration(x, v) - friction) - carried_ * loose_.load + held_.push;
  }
  /// The change of z, which a wall doesn't leave.
  [[nodiscard]] Row place_in_housing() const { return on_wall_ ? Row{} : combined(1, map_[2], -1, map_[0]); }
  void move_with_main(const Row& place) { map_[2] = combined(1, map_[0], 1, place), map_[3] = map_[1]; }
  void lose(std::size_t numbers) { lost_ = std::max(lost_, numbers); }

  /// y'' of a loose mass by itself.
  template <class A>
  [[nodiscard]] double load_on(const A& arc) const {
    if constexpr (Housed<A>)
      if constexpr (requires { arc.loose.load(); }) return arc.loose.load();
    return loose_.load;
  }
  /// The push of a soft wall on the main mass a time s after the start of an arc.
  template <class A>
  [[nodiscard]] static double push_on(const A& arc, double s) {
    if constexpr (Housed<A>)
      if constexpr (requires { arc.loose.coupling(); }) {
        const Motion<double> z = arc.loose.at(s);
        return arc.loose.coupling().push(z.offset, z.v);
      }
    return 0.0;
  }
  /// The soft wall against which friction holds a loose mass: its push on the main mass, and its stiffness.
  struct HeldInWall {
    double push = 0.0, stiffness = 0.0;
  };
  template <class A>
  [[nodiscard]] HeldInWall held_in(const A& arc) const {
    if constexpr (Housed<A>)
      if constexpr (requires { arc.loose.place; })
        for (const Side side : {Side::lower, Side::upper}) {
          const SoftStop<double> wall = soft_wall_at<double>(loose_, side);
          const double offset = arc.loose.place - wall.position;
          if (wall.side != Side::none && wall.into(offset) > 0) return {wall.stiffness * offset, wall.stiffness};
        }
    return {};
  }
  /// y'' there of a loose mass that doesn't move with the main one.
  template <class A>
  [[nodiscard]] double loose_acceleration(const A& arc, double s) const {
    return load_on(arc) - push_on(arc, s) / rule_.ratio;
  }
  /// Carries the changes over an arc, of a loose mass by itself those of y, too.
  template <class A>
  void flow(const A& arc, double length) {
    if constexpr (Housed<A>)
      if constexpr (requires { arc.loose.coupling(); }) {
        const LooseJacobian flow = flow_of(arc.loose, length), from = map_;
        for (std::size_t i = 0; i < map_.size(); ++i) {
          map_[i] = combined(flow[i][0], from[0], flow[i][1], from[1]);
          add(map_[i], flow[i][2], from[2]), add(map_[i], flow[i][3], from[3]);
        }
        return;
      }
    const auto p = arc.constants().propagator(length);
    const Row x = combined(p.a, map_[0], p.b, map_[1]),
              v = combined(-arc.constants().spring(p.b), map_[0], p.c, map_[1]);
    map_[0] = x, map_[1] = v;
    if (arc.constants().carried == 0) map_[2] = combined(1, map_[2], length, map_[3]);
  }
  /// What the end of an arc tells if friction in the housing has come to hold the loose mass, or no longer does so.
  template <class A>
  void note_end(const A& arc, double length, bool is_held) {
    const auto end = arc.at(length);
    end_ = {end.a, arc.constants().jerk(end), is_held, end.sine};
  }
  /// Friction in the housing stops the loose mass, or turns it, where z' falls to 0, and lets it go where x'' passes
  /// the level (eq. 81). A main mass that something holds goes as that turns, or lets the loose one go as it goes.
  void change_hold(bool carries, double load, bool is_held) {
    if (carried_ == 0 && (carries || load != load_)) {
      const double towards = end_.a - alone_;
      expect(combined(1 / towards, map_[3], -1 / towards, map_[1]), end_.a, alone_);
      sticks_ = sticks_ && is_held;
    } else if (carried_ != 0 && !carries && !end_.is_held) {
      Row late = combined(k_ / end_.jerk, map_[0], 2 * h_ / end_.jerk, map_[1]);
      if (held_.stiffness != 0)
        add(late, -held_.stiffness / rule_.ratio / end_.jerk, combined(1, map_[2], -1, map_[0]));
      expect(late, end_.a, end_.a);
    }
    is_told_ = false;
  }

  /// An event that comes the later by `late` for each small change, after which the accelerations are supposed to be
  /// these; the next arc knows them.
  void expect(const Row& late, double a, double a_loose) { late_ = late, a_ = a, a_loose_ = a_loose, is_told_ = true; }
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
    if (carried_ != 0) add(map_[3], a - alone_, late);
    map_[0] = combined(e.after / e.before, map_[0], 0, map_[0]);
    map_[1] = combined(slope, map_[1], slope * a - a_after, late);
    expect(late, a_after, alone_);
    carried_ = 0, rescale();
  }
  /// The damper of a soft stop pushes from the touch on (eq. 53).
  void touch(const Event& e) {
    const double push = 2 * soft_stop_at<double>(stops_, e.side).damping / (1 + carried_) * e.before;
    const double a_after = acceleration(e.place, e.before) - push;
    const Row late = combined(-1 / e.before, map_[0], 0, map_[0]);
    add(map_[1], push, late);
    if (carried_ != 0) map_[3] = map_[1];
    expect(late, a_after, carried_ != 0 ? a_after : alone_);
  }
  /// The acceleration jumps where the velocity is 0 (eq. 64).
  void reverse(const Event& e) {
    const Row late = combined(-1 / e.a_before, map_[1], 0, map_[1]);
    map_[1] = combined(e.a_after / e.a_before, map_[1], 0, map_[1]);
    if (carried_ != 0) map_[3] = map_[1];
    expect(late, e.a_after, carried_ != 0 ? e.a_after : alone_);
  }
  void rest() {
    const Row place = place_in_housing();
    map_[0] = map_[1] = {};
    if (carried_ != 0) move_with_main(place);
    lose(2), sticks_ = false, late_ = {};
  }
  /// A loose mass that is carried may go on by itself.
  void stick(const Event& e) {
    const double a = acceleration(e.place, 0);
    late_ = {};
    if (begun_ && !sticks_) expect(combined(-1 / a, map_[1], 0, map_[1]), 0, carried_ != 0 ? 0 : alone_);
    map_[1] = {};
    if (carried_ != 0) map_[3] = {};
    sticks_ = true;
  }
  /// A stick ends the later the further the spring has to be overcome (eq. 65).
  void release(double a, double a_loose, double later) {
    sticks_ = false;
    if (a == 0) return;
    add(map_[1], -a * later, map_[0]);
    if (carried_ != 0) add(map_[3], -a_loose * later, map_[0]);
  }
  /// An impact on a wall with z' = w.
  void strike(double w, const Event::Main& main) {
    if (w == 0) return;
    const double drag = 2 * rule_.ratio * (loose_.load - load_);  // by how much friction in the housing turns round
    const double a = acceleration(main.place, main.before), a_after = acceleration(main.place, main.after) - drag,
                 towards = alone_ - a;
    const Restitution<double>& law = rule_.law_for(w);
    const double jump = rule_.share() * (1 + law.share(w));       // of x' by z'
    const double kick = rule_.share() * (1 - law.derivative(w));  // its derivative, and
    const double back = kick / rule_.ratio;                       // that of -y'
    const Row z = combined(1, map_[2], -1, map_[0]), dw = combined(1, map_[3], -1, map_[1]);
    add(map_[0], jump, z);
    add(map_[1], kick, dw), add(map_[1], (a_after - a - kick * towards) / w, z);
    add(map_[2], -jump / rule_.ratio, z);
    add(map_[3], -back, dw), add(map_[3], (back * towards + drag / rule_.ratio) / w, z);
    expect(combined(-1 / w, z, 0, z), a_after, alone_ + drag / rule_.ratio);
    sticks_ = false, rescale();
  }
  /// The damper of a soft wall pushes both masses from the touch on.
  void touch_wall(double w, const Event::Main& main) {
    const double a = acceleration(main.place, main.before);
    expect(combined(-1 / w, map_[2], 1 / w, map_[0]), a, alone_);
  }
  /// Both masses keep their common centre and momentum.
  void press() {
    const double share = rule_.share();
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
      map_[i] = map_[i + 2] = combined(1 - share, map_[i], share, map_[i + 2]);
    a_ = a_loose_ = (1 - share) * a_ + share * a_loose_, carried_ = rule_.ratio, on_wall_ = is_told_ = true, lose(2);
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
  std::size_t lost_ = 0;
  bool is_rough_;               ///< it rubs on the housing
  bool sticks_ = false;         ///< friction has held the main mass since
  Row late_{};                  ///< by which the last event is late, until the next arc begins,
  double a_ = 0, a_loose_ = 0;  ///< and the accelerations after it
  double h_ = 0, k_ = 1;        ///< damping and stiffness of the last arc,
  double force_ = 0;            ///< the force on the main mass at x = 0 at its end,
  double friction_ = 0;         ///< of which so much is friction,
  double carried_ = 0;          ///< and the loose mass, if it moves with the main one
  HeldInWall held_{};           ///< against which friction holds it then,
  bool on_wall_ = true;         ///< which presses it then; else friction holds it, at any place
  double load_ = loose_.load;   ///< y'' of the loose mass beside the last arc, without the push of a soft wall,
  double alone_ = loose_.load;  ///< and with that at its end
  bool begun_ = false;          ///< there is a last arc
  bool is_told_ = true;         ///< an event tells what follows it
  /// With friction in the housing, at the end of the last arc.
  struct End {
    double a = 0, jerk = 0;
    bool is_held = false;  ///< something holds the main mass
    double sine = 0;       ///< of the phase of the force
  } end_{};
};

}  // namespace clatter::motion
