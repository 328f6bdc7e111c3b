#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "motion/event.hpp"
#include "motion/soft_stop.hpp"
#include "scene/scene.hpp"

namespace clatter::steady {

/// Finds the period of unforced motion: the time between two impacts, or two contacts with a soft stop, that leave the
/// same stop with the same speed.
/// Unforced motion is a curve in the plane of x and x', so it has returned when that one number has.
class ReturnObserver {
 public:
  ReturnObserver(const Scene& scene, double tolerance)
      : tolerance_(tolerance),
        stops_(scene.stops),
        equilibrium_(equilibrium_of(scene.oscillator)),
        stiffness_(scene.oscillator.stiffness),
        is_loaded_(scene.oscillator.load != 0.0),
        damped_(scene.oscillator.damping > 0.0),
        scale_(std::max({std::abs(scene.start.displacement), std::abs(scene.start.velocity), std::abs(equilibrium_)})),
        conserved_(!damped_) {}

  template <class A>
  void arc(const A&, double, double) {}
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    touched_ = touched_ || event.is_contact();
    if (event.kind == Kind::impact) conserved_ = conserved_ && std::abs(event.after) == std::abs(event.before);
    if (event.kind == Kind::separation)
      conserved_ = conserved_ && motion::soft_stop_at<double>(stops_, event.side).damping == 0;
    if (event.kind == Kind::impact || event.kind == Kind::separation) leave({event.time, event.after}, event.side);
  }

  /// Begins the next period; impacts then count their time from there.
  void begin_period(double turn) {
    touched_ = false;
    for (Leaving& last : last_) last.time -= turn;
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
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  /// The end of an impact or a contact.
  struct Leaving {
    double time = 0.0, velocity = nan;
  };

  void leave(const Leaving& now, Side side) {
    Leaving& last = last_[index_of(side)];
    const bool again = std::abs(now.velocity - last.velocity) <= tolerance_ * std::abs(now.velocity);
    if (again && now.velocity != 0.0 && !(period_ > 0.0)) period_ = now.time - last.time;
    last = now;
  }

  double tolerance_;
  Stops stops_;
  double equilibrium_, stiffness_;
  bool is_loaded_, damped_;
  double scale_;  ///< the larger of |x| and |x'| at the start and |equilibrium|
  bool conserved_;
  bool touched_ = false;
  double period_ = 0.0;
  std::array<Leaving, 2> last_{};  ///< [stop]
};

}  // namespace clatter::steady
