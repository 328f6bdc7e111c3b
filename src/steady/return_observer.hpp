#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/scene.hpp"
#include "motion/state.hpp"

namespace clatter::steady {

/// Finds the period of unforced motion: the time between two impacts that leave the same stop with the same speed.
/// Unforced motion is a curve in the plane of x and x', so it has returned when that one number has.
class ReturnObserver {
 public:
  ReturnObserver(const Scene& scene, double tolerance)
      : tolerance_(tolerance),
        equilibrium_(equilibrium_of(scene.oscillator)),
        stiffness_(scene.oscillator.stiffness),
        is_loaded_(scene.oscillator.load != 0.0),
        damped_(scene.oscillator.damping > 0.0),
        scale_(std::max({std::abs(scene.start.displacement), std::abs(scene.start.velocity), std::abs(equilibrium_)})),
        conserved_(!damped_) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest&) {}
  void impact(const motion::Impact& impact) {
    touched_ = true;
    conserved_ = conserved_ && std::abs(impact.after) == std::abs(impact.before);
    motion::Impact& last = last_[index_of(impact.side)];
    const bool again = std::abs(impact.after - last.after) <= tolerance_ * std::abs(impact.after);
    if (again && impact.after != 0.0 && !(period_ > 0.0)) period_ = impact.time - last.time;
    last = impact;
  }

  /// Begins the next period; impacts then count their time from there.
  void begin_period(double turn) {
    touched_ = false;
    for (motion::Impact& last : last_) last.time -= turn;
  }
  [[nodiscard]] double period() const { return period_; }  ///< 0 while the motion has not returned
  /// Whether no energy was lost since the start, which is then on the periodic motion.
  [[nodiscard]] bool conserved() const { return conserved_; }
  /// Whether undamped motion has passed a whole period of the spring without impact: then none will come.
  [[nodiscard]] bool free_rotation() const { return !touched_ && !damped_ && stiffness_ > 0; }

  /// Whether the mass is held by a stop, or so near the equilibrium that the rest of the motion is below the tolerance.
  /// Without spring and load any place is one, with a load and no spring none; that of an unstable spring holds only a
  /// mass that is exactly there.
  [[nodiscard]] bool stands_still(double x, double v, bool held) const {
    if (held) return true;
    if (stiffness_ == 0 && is_loaded_) return false;
    const double left = std::max(stiffness_ == 0 ? 0.0 : std::abs(x - equilibrium_), std::abs(v));
    return left == 0.0 || (!conserved_ && stiffness_ >= 0 && left <= least());
  }
  /// Displacements and velocities up to this size count as 0.
  [[nodiscard]] double least() const { return tolerance_ * scale_; }

 private:
  double tolerance_, equilibrium_, stiffness_;
  bool is_loaded_, damped_;
  double scale_;  ///< the larger of |x| and |x'| at the start and |equilibrium|
  bool conserved_;
  bool touched_ = false;
  double period_ = 0.0;
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<motion::Impact, 2> last_{motion::Impact{0, Side::lower, nan, nan, nan},
                                      motion::Impact{0, Side::upper, nan, nan, nan}};
};

}  // namespace clatter::steady
