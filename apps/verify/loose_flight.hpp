#pragma once

#include "flow.hpp"

namespace verify {

/// The motion of a loose mass in its housing between two impacts, z = y - x, of which y is a parabola.
class FlightInHousing {
 public:
  FlightInHousing(const Flow::Flight& main, const Ball& z, const Ball& w, const Ball& load)
      : main_(main), load_(load), start_(main.at(Ball(0))), z_(z), w_(w) {}

  /// z and its derivatives.
  [[nodiscard]] Flow::Instant at(const Ball& s) const {
    const Flow::Instant main = main_.at(s);
    const Ball way = (w_ + start_.v + load_ * s / Ball(2)) * s - (main.x - start_.x);
    return {z_ + (abs(s) < Ball(0.05) ? way.within(short_way(s)) : way), w_ + load_ * s - (main.v - start_.v),
            load_ - main.a, -main.j, -main.d4};
  }

 private:
  /// The way by Taylor's theorem: over a short time that of the main mass, whose place is known in bounds wider than
  /// the way, doesn't count.
  [[nodiscard]] Ball short_way(const Ball& s) const {
    const Ball last = main_.at(Ball::hull(Ball(0), s)).d4;
    return s * (w_ + s / Ball(2) * (load_ - start_.a - s / Ball(3) * (start_.j + s / Ball(4) * last)));
  }

  Flow::Flight main_;
  Ball load_;
  Flow::Instant start_;  ///< of the main mass
  Ball z_, w_;
};

/// The acceleration load - x'' with which both masses as one press the loose one on a wall: on the upper one if it is
/// positive, on the lower one if it is negative.
class WallForce {
 public:
  /// `both` is the scene of the two masses as one.
  WallForce(const Flow::Flight& main, const Scene& both, const Ball& time, const Ball& load)
      : main_(main), both_(both), time_(time), load_(load) {}

  [[nodiscard]] Flow::Instant at(const Ball& s) const {
    const Flow::Instant main = main_.at(s);
    const auto [sine, cosine] = sin_cos(both_.nu * (time_ + s) + both_.phase);
    const Ball damping = Ball(2) * both_.h, fast = both_.f * both_.nu * square(both_.nu);
    const Ball d5 = -damping * main.d4 - both_.k * main.j - fast * cosine;
    return {load_ - main.a, -main.j, -main.d4, -d5, damping * d5 + both_.k * main.d4 - fast * both_.nu * sine};
  }

 private:
  Flow::Flight main_;
  const Scene& both_;
  Ball time_, load_;
};

}  // namespace verify
