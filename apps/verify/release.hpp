#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "force.hpp"

namespace verify {

/// Turns by which the phases of a turn at which something lets a mass go are apart at least.
constexpr double releases_apart = 1e-6;

/// What holds a mass against a pull to a side, as a function of the phase of the force: it lets go where that falls to
/// 0.
template <class Number>
struct Press {
  BasicForce<Number> force;
  Number sign, constant;

  /// It and its derivative by the phase.
  [[nodiscard]] std::pair<Number, Number> at(const Number& theta) const {
    const auto [value, slope] = force.at(theta);
    return {sign * value + constant, sign * slope};
  }
};

/// The phases of a turn at which it falls to 0, in their order. Throws Undecided if they can't be told.
[[nodiscard]] std::vector<Ball> falls_of(const Press<Ball>& press);
/// With their derivatives by the parameter.
[[nodiscard]] std::vector<Dual> falls_of(const Press<Dual>& press);

/// Of the phases of a turn, in their order, which one, and whole turns beside it.
struct PhaseOfRelease {
  slong turns = 0;
  std::size_t number = 0;

  /// The phase itself.
  template <class Number>
  [[nodiscard]] Number of(const std::vector<Number>& phases) const {
    return phases[number] + Number(Ball(turns) * Ball(2) * Ball::pi());
  }
};
/// The first one after a phase, or the nearest one. Throws Undecided if there is none, or that can't be told.
[[nodiscard]] PhaseOfRelease first_after(const std::vector<Ball>& phases, const Ball& here);
[[nodiscard]] PhaseOfRelease nearest_to(const std::vector<Ball>& phases, const Ball& here);

}  // namespace verify
