#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/scene.hpp"
#include "motion/state.hpp"

namespace clatter::steady {

/// Watches unforced motion for its own period: the time between two impacts on one stop that leave it with the same
/// speed. Such motion is a curve in the plane of x and x', so it has returned when that one number has.
class ReturnObserver {
 public:
  ReturnObserver(const Scene& scene, double tolerance)
      : tolerance_(tolerance),
        equilibrium_(scene.oscillator.load),
        damped_(scene.oscillator.damping > 0.0),
        scale_(std::max({std::abs(scene.start.displacement), std::abs(scene.start.velocity), std::abs(equilibrium_)})),
        conserved_(!damped_) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact& impact) {
    touched_ = true;
    conserved_ = conserved_ && std::abs(impact.after) == std::abs(impact.before);
    motion::Impact& last = last_[impact.side == Side::upper ? 1 : 0];
    const bool again = std::abs(impact.after - last.after) <= tolerance_ * std::abs(impact.after);
    if (again && impact.after != 0.0 && !(period_ > 0.0)) period_ = impact.time - last.time;
    last = impact;
  }

  /// Begins the next turn of 2 pi, from which impacts then count their time.
  void begin_period(double turn) {
    touched_ = false;
    for (motion::Impact& last : last_) last.time -= turn;
  }
  [[nodiscard]] double period() const { return period_; }  ///< 0 while the motion has not returned
  [[nodiscard]] bool conserved() const {
    return conserved_;
  }  ///< no energy was lost since the start, which is then on the periodic motion
  [[nodiscard]] bool free_rotation() const {
    return !touched_ && !damped_;
  }  ///< a whole turn without impact: none will come

  /// Held by a stop, at the equilibrium, or so near to it that the rest of the motion is below the tolerance.
  [[nodiscard]] bool stands_still(double x, double v, bool held) const {
    const double left = std::max(std::abs(x - equilibrium_), std::abs(v));
    return held || left == 0.0 || (!conserved_ && left <= least());
  }
  /// Displacements and velocities that count as none.
  [[nodiscard]] double least() const { return tolerance_ * scale_; }

 private:
  double tolerance_, equilibrium_;
  bool damped_;
  double scale_;  ///< the larger of |x| and |x'| at the start and |load|
  bool conserved_;
  bool touched_ = false;
  double period_ = 0.0;
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<motion::Impact, 2> last_{motion::Impact{0, Side::lower, nan, nan, nan},
                                      motion::Impact{0, Side::upper, nan, nan, nan}};
};

}  // namespace clatter::steady
