#pragma once

#include <algorithm>
#include <cmath>

#include "hard/any_scene.hpp"
#include "hard/tally.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::hard {

/// The depth that motion reaches in soft stops, over the most that its energy allows. With K = k + kappa and P the
/// largest constant force into a stop, |f| and that of load and spring at its position, K d^2/2 - P d + v^2/2 never
/// grows while the mass moves inwards: the dampers take energy, the force gives no more than P does, and a stop that is
/// outrun moves outwards. So motion that touches at a speed v reaches at most the depth
///
///   d = (P + (P^2 + K v^2)^(1/2)) / K,
///
/// and motion that turns back inwards within the stop, at d0 < d1 and K d1^2/2 - P d1 <= K d0^2/2 - P d0, no more than
/// d1 <= 2 P/K - d0, which is less.
class Penetration : public Watcher {
 public:
  explicit Penetration(const point::Problem& scene) : oscillator_(scene.oscillator), stops_(scene.stops) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    const Side side = arc.constants().stop.side;
    if (side == Side::none) return;
    const auto stop = arc.constants().stop;
    const auto& m = arc.start();
    if (side != side_) begin(stop, stop.into(m.offset), std::max(0.0, stop.into(m.v)));
    if (!(limit_ > 0)) return;
    const double depth = deepest(arc, length, stop);
    raise(over_, depth / limit_), deep_ = deep_ || depth > limit_ / 2;
  }
  void touch(const motion::Event& touch) { side_ = touch.kind == motion::Event::Kind::touch ? Side::none : side_; }

  [[nodiscard]] double over() const { return over_; }   ///< depth over the limit
  [[nodiscard]] bool is_deep() const { return deep_; }  ///< more than half of the limit
  [[nodiscard]] bool is_met() const { return over_ > 0; }

 private:
  /// A motion that begins at a depth of its own, or at a touch.
  void begin(const motion::SoftStop<double>& stop, double depth, double speed) {
    const double K = oscillator_.stiffness + stop.stiffness,
                 P = std::abs(oscillator_.forcing) + stop.into(constant_force(oscillator_, stop.position));
    const double from = P - K * depth;
    limit_ = std::max({depth, 2 * P / K, (P + std::sqrt(from * from + K * speed * speed)) / K}), side_ = stop.side;
  }

  /// The depth where the mass turns back, sampled densely enough not to pass by a turn, and bisected.
  template <class A>
  [[nodiscard]] static double deepest(const A& arc, double length, const motion::SoftStop<double>& stop) {
    const auto speed = [&](double s) { return stop.into(arc.at(s).v); };
    const auto looks = static_cast<int>(std::clamp(8 * length * arc.constants().rate, 8.0, 1000.0));
    double most = std::max(stop.into(arc.start().offset), stop.into(arc.at(length).offset)), left = speed(0);
    for (int i = 1; i <= looks; ++i) {
      const double right = speed(length * i / looks);
      if (left > 0 && right <= 0) {
        double low = length * (i - 1) / looks, high = length * i / looks;
        for (int k = 0; k < 30; ++k) (speed((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
        most = std::max(most, stop.into(arc.at(low).offset));
      }
      left = right;
    }
    return most;
  }

  Oscillator oscillator_;
  Stops stops_;
  Side side_ = Side::none;  ///< the stop that the limit belongs to
  double limit_ = 0, over_ = 0;
  bool deep_ = false;
};

}  // namespace clatter::hard
