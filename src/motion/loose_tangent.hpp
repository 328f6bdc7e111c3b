#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "motion/event.hpp"
#include "motion/state.hpp"
#include "motion/walls.hpp"

namespace clatter::motion {

/// A linear map of small changes (dx, dx', dy, dy'), by rows.
using LooseJacobian = std::array<std::array<double, 4>, 4>;

/// The derivative of a motion with a loose mass with respect to its start: free motion of both masses, the saltation
/// matrix at each impact on a wall (eq. 73), and the motion of the two as one while a wall presses, which keeps nothing
/// of z and z'. It is kept times a power of two, so that nothing overflows.
class LooseTangent {
 public:
  LooseTangent(const Oscillator& oscillator, const LooseMass& loose)
      : h_(oscillator.damping), k_(oscillator.stiffness), loose_(loose), rule_{loose.ratio, {loose.restitution}} {}

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto& constants = arc.constants();
    const auto p = constants.propagator(length);
    const Row x = combined(p.a, map_[0], p.b, map_[1]), v = combined(-constants.spring(p.b), map_[0], p.c, map_[1]);
    map_[0] = x, map_[1] = v;
    if (constants.carried != 0) {
      map_[2] = x, map_[3] = v, has_pressed_ = true;
    } else {
      map_[2] = combined(1, map_[2], length, map_[3]);
      force_ = constants.force(arc.phase_after(length).sine);
    }
    rescale();
  }
  void event(const Event& event) {
    if (event.kind == Event::Kind::strike) strike(event.before, event.main);
    if (event.kind == Event::Kind::press) press();
  }

  /// Makes the map that from here on, between an arc and the event at its end, too.
  void begin_anew() { map_ = identity, exponent_ = 0; }

  [[nodiscard]] LooseJacobian map() const {
    LooseJacobian map = map_;
    for (Row& row : map)
      for (double& entry : row) entry *= std::exp2(exponent_);
    return map;
  }
  /// The map without its power of two.
  [[nodiscard]] const LooseJacobian& mantissa() const { return map_; }
  [[nodiscard]] double exponent() const { return exponent_; }  ///< of two, a whole number
  /// Whether a press has left no more than two numbers of a change.
  [[nodiscard]] bool has_pressed() const { return has_pressed_; }

 private:
  using Row = std::array<double, 4>;
  static constexpr LooseJacobian identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  /// An impact on a wall with z' = w.
  void strike(double w, const Event::Main& main) {
    if (w == 0) return;
    const double force = force_ - k_ * main.place, a = force - 2 * h_ * main.before,
                 a_after = force - 2 * h_ * main.after, towards = loose_.load - a;
    const double kick = -rule_.share() * rule_.law.jump(1.0), back = kick / rule_.ratio;  // of x' and -y' by z'
    const Row z = combined(1, map_[2], -1, map_[0]), dw = combined(1, map_[3], -1, map_[1]);
    add(map_[0], kick, z);
    add(map_[1], kick, dw), add(map_[1], (a_after - a - kick * towards) / w, z);
    add(map_[2], -back, z);
    add(map_[3], -back, dw), add(map_[3], back * towards / w, z);
    rescale();
  }
  /// Both masses keep their common centre and momentum.
  void press() {
    const double share = rule_.share();
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
      map_[i] = map_[i + 2] = combined(1 - share, map_[i], share, map_[i + 2]);
    has_pressed_ = true;
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
    for (Row& row : map_)
      for (double& entry : row) entry = std::ldexp(entry, shift);
    exponent_ -= shift;
  }

  double h_, k_;
  LooseMass loose_;
  WallRule<double> rule_;
  LooseJacobian map_ = identity;
  double exponent_ = 0;
  bool has_pressed_ = false;
  double force_ = 0;  ///< on the main mass at x = 0, at the end of the last arc
};

}  // namespace clatter::motion
