#pragma once

#include <optional>

#include "flow.hpp"

namespace verify {

/// What a margin is of: the displacement, or what belongs to a loose mass: z in flight, the force of the wall that
/// presses it in a press.
enum class Of { main, loose };

/// The quantities of both masses at an instant, with their derivatives.
struct Moment {
  Flow::Instant main, loose;
  Ball held_at{};  ///< z of a loose mass that moves with the main one

  [[nodiscard]] const Flow::Instant& of(Of which) const { return which == Of::main ? main : loose; }
};

/// The motion of the main mass between two events, and that of a loose one beside it, as functions of the time s.
class MachineFlight {
 public:
  MachineFlight(const Flow::Flight& main) : main_(main) {}  // NOLINT(google-explicit-constructor): without a loose mass

  /// Between two walls z = y - x is a parabola less the motion of the main mass.
  [[nodiscard]] static MachineFlight flying(const Flow::Flight& main, const Ball& z, const Ball& w, const Ball& load) {
    MachineFlight flight(main);
    flight.loose_ = Loose{load, main.at(Ball(0)), z, w};
    return flight;
  }
  /// Both masses as one, `main`, hold the loose one at z with the acceleration load - x'' beside it: it presses on the
  /// upper wall if that is positive, on the lower one if it is negative.
  [[nodiscard]] static MachineFlight pressed(const Flow::Flight& main, const Ball& z, const Ball& load) {
    MachineFlight flight(main);
    flight.held_ = Held{load, z};
    return flight;
  }

  [[nodiscard]] const Flow::Flight& main() const { return main_; }
  [[nodiscard]] Moment at(const Ball& s) const {
    const Flow::Instant main = main_.at(s);
    if (loose_) return {main, in_housing(s, main), {}};
    if (!held_) return {main, {}, {}};
    const auto [d5, d6] = main_.further(s, main);
    return {main, {held_->load - main.a, -main.j, -main.d4, -d5, -d6}, held_->z};
  }

 private:
  struct Loose {
    Ball load;
    Flow::Instant start;  ///< of the main mass
    Ball z, w;
  };
  struct Held {
    Ball load, z;
  };

  [[nodiscard]] Flow::Instant in_housing(const Ball& s, const Flow::Instant& main) const {
    const auto& [load, start, z, w] = *loose_;
    const Ball way = (w + start.v + load * s / Ball(2)) * s - (main.x - start.x);
    return {z + (abs(s) < Ball(0.05) ? way.within(short_way(s)) : way), w + load * s - (main.v - start.v),
            load - main.a, -main.j, -main.d4};
  }
  /// The way by Taylor's theorem: over a short time that of the main mass, whose place is known in bounds wider than
  /// the way, doesn't count.
  [[nodiscard]] Ball short_way(const Ball& s) const {
    const auto& [load, start, z, w] = *loose_;
    const Ball last = main_.at(Ball::hull(Ball(0), s)).d4;
    return s * (w + s / Ball(2) * (load - start.a - s / Ball(3) * (start.j + s / Ball(4) * last)));
  }

  Flow::Flight main_;
  std::optional<Loose> loose_{};
  std::optional<Held> held_{};
};

}  // namespace verify
