#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "hard/any_scene.hpp"
#include "hard/tally.hpp"
#include "hard/taylor_scan.hpp"

namespace clatter::hard {

/// Computes every arc of a motion again by Taylor steps and checks every rest by its force. Deviations are in units of
/// the allowed rounding: `ulps` of the sizes of the sums that form a displacement, a velocity or a force.
class Rescan : public Watcher {
 public:
  explicit Rescan(const point::Problem& scene)
      : oscillator_(scene.oscillator),
        stops_(scene.stops),
        phase_(scene.start.phase),
        x_(scene.start.displacement),
        v_(scene.start.velocity) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    const auto& m = arc.start();
    check_start(m, begin);
    anchor_ = arc.anchor();
    flight_ = TaylorScan(oscillator_, anchor_).fly({m.offset, m.v, m.sine, m.cosine}, length);
    allow(m, length, arc.constants().rate);
    raise(missed,
          ratio(std::max(rise_of(stops_.lower) - flight_.lowest, flight_.highest - rise_of(stops_.upper)), near_));
    flying_ = true, rebound_ = 0;
  }
  void impact(const motion::Event& impact) {
    const bool upper = impact.side == Side::upper, moving_in = upper ? impact.before > 0 : impact.before < 0;
    const double R = (upper ? stops_.restitution_upper : stops_.restitution_lower).R;
    if (impact.after != (moving_in ? -R * impact.before : impact.before)) broken = infinity;
    check_arrival(impact.place, impact.before);
    x_ = impact.place, v_ = impact.after, rebound_ = impact.after;
    flying_ = false;
  }
  void rest(const motion::Event& rest) {
    if (rest.held || rebound_ != 0)
      check_pressed(rest);
    else
      check_hover(rest);
    x_ = rest.place, v_ = 0, rebound_ = 0;
  }
  void section(const motion::State<double>& state) {
    if (flying_) {
      raise(position, ratio(std::abs(rise_of(state.x) - flight_.end.offset), whole_));
      raise(speed, ratio(std::abs(state.v - flight_.end.v), fast_));
    }
    if (!flying_ && (state.x != x_ || state.v != v_)) broken = infinity;
    x_ = state.x, v_ = state.v, flying_ = false, rebound_ = 0;
  }

  double missed = 0;    ///< penetration of a stop
  double position = 0;  ///< distance of an arc's end from the stop that is hit, or from the reported displacement
  double speed = 0;     ///< the same of its velocity
  double pressed = 0;   ///< force that pulls a resting mass off its stop
  double broken = 0;    ///< an arc that doesn't begin in the state or phase in which the last one ended; eq. 4 violated

 protected:
  using Real = TaylorScan::Real;
  static constexpr double ulps = 16;  ///< of sums of some ten terms, each with a rounding or two of its own
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  [[nodiscard]] Real rise_of(double x) const { return static_cast<Real>(x) - anchor_; }

  [[nodiscard]] static double ratio(Real deviation, double allowed) {
    return deviation > 0 ? static_cast<double>(deviation / allowed) : 0.0;
  }

  /// The allowed rounding in a flight. The displacement of a short flight is accurate relative to its offset; that of a
  /// longer one is a sum of forced response and free motion, which near resonance are larger than their sum.
  template <class M>
  void allow(const M& m, double length, double rate) {
    const auto& [h, f, nu, load, k, shape, paces] = oscillator_;
    const double natural = std::sqrt(std::abs(k)), near = k > 0 ? 16 / k : 16.0;
    const double response = f == 0 ? 0
                                   : std::abs(f) * std::min(1 / std::hypot(k - nu * nu, 2 * h * nu),
                                                            near + length / std::max(natural, 1e-3));
    // the time over which an error of the force adds up, before the spring brings it back
    const double part = std::min(length, k == 1 ? 1.0 : 1 / std::max(natural, 1e-300));
    const double terms = length * rate > 0.25 ? response * std::min(1.0, length) : 0;
    const double way = std::abs(m.offset) + std::abs(m.v) * part;    // the offset that it reaches without a force
    const double growth = k < 0 ? std::exp(natural * length) : 1.0;  // of what rounding has left
    // load - x is exact close to the equilibrium, the product k x is rounded
    const double pull = k == 1 ? std::abs(load - anchor_) : std::abs(load) + std::abs(k * anchor_);
    acceleration_ = pull + std::abs(k) * way + std::abs(f) + 2 * h * std::abs(m.v);
    const double unit = ulps * epsilon<double>() * growth;
    near_ = unit * (way + acceleration_ * part * part + terms);
    whole_ = near_ + unit * (std::abs(anchor_) + std::abs(k == 0 ? load * part * part : load / k) + terms);
    // without a spring a damped velocity fades below all normal numbers
    fast_ = unit * (std::abs(m.v) + acceleration_ * part + terms * std::max(natural, nu)) +
            std::numeric_limits<double>::min();
  }

  /// Checks that an arc begins in the last state.
  template <class M>
  void check_start(const M& m, double begin) {
    if (flying_ || m.x != x_ || m.v != v_) broken = infinity;
    check_phase(m, begin);
  }

  /// Checks that a flight ends at a stop with a velocity.
  void check_arrival(double x, double v) {
    raise(position, ratio(std::abs(rise_of(x) - flight_.end.offset), near_));
    raise(speed, ratio(std::abs(v - flight_.end.v), fast_ + speed_rounding(v)));
  }
  /// If the displacement is known to d, v^2 is known to 2 a d.
  [[nodiscard]] double speed_rounding(double v) const {
    return acceleration_ * near_ / std::max(std::abs(v), std::sqrt(acceleration_ * near_));
  }

  [[nodiscard]] Real angle(double time) const { return phase_ + static_cast<Real>(oscillator_.frequency) * time; }

  template <class M>
  void check_phase(const M& m, double begin) {
    if (oscillator_.forcing == 0) return;
    const double off = static_cast<double>(
        std::max(std::abs(m.sine - std::sin(angle(begin))), std::abs(m.cosine - std::cos(angle(begin)))));
    raise(broken, off / (ulps * epsilon<double>()));  // a phase in turns is known to an ulp
  }

  /// The force on a mass at rest, f sin(theta) + load - k x, into its stop (eq. 22).
  [[nodiscard]] Real force(const motion::Event& rest, Real sine) const {
    return sign_of(rest.side) * (oscillator_.forcing * sine + (static_cast<Real>(oscillator_.load) -
                                                               static_cast<Real>(oscillator_.stiffness) * rest.place));
  }
  [[nodiscard]] double force_rounding(const motion::Event& rest) const {
    return ulps * epsilon<double>() *
           (std::abs(oscillator_.forcing) + std::abs(oscillator_.load) + std::abs(oscillator_.stiffness * rest.place));
  }

  /// Checks that the force presses all the time, also at its least.
  void check_pressed(const motion::Event& rest) {
    constexpr int looks = 16;
    Real least =
        std::min(force(rest, std::sin(angle(rest.time))), force(rest, std::sin(angle(rest.time + rest.length))));
    for (int i = 1; i < looks; ++i)
      least = std::min(least, force(rest, std::sin(angle(rest.time + rest.length * i / looks))));
    raise(pressed, ratio(-least, force_rounding(rest)));
  }

  /// Checks that the force is so small that the mass would move by less than rounding.
  void check_hover(const motion::Event& rest) {
    const Real largest = std::max(std::abs(force(rest, std::sin(angle(rest.time)))),
                                  std::abs(force(rest, std::sin(angle(rest.time + rest.length)))));
    raise(pressed, ratio(largest * rest.length * rest.length / 2, force_rounding(rest)));
  }

  Oscillator oscillator_;
  Stops stops_;
  Real phase_;
  double x_, v_;        ///< the last reported state
  double rebound_ = 0;  ///< velocity after an impact that nothing has followed yet
  bool flying_ = false;
  double anchor_ = 0;
  TaylorScan::Flight flight_{};
  double near_ = 0, whole_ = 0, fast_ = 0, acceleration_ = 0;
};

}  // namespace clatter::hard
