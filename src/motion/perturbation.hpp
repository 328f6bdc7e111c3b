#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/state.hpp"

namespace clatter::motion {

/// A linear map of small changes (dx, dv), by rows.
template <class Number>
using Jacobian = std::array<Number, 4>;

/// A small change of a state.
struct Perturbation {
  double x = 0.0, v = 0.0;

  [[nodiscard]] double size() const { return std::max(std::abs(x), std::abs(v)); }
};

[[nodiscard]] inline Perturbation between(const State<double>& from, const State<double>& to) {
  return {to.x - from.x, to.v - from.v};
}

[[nodiscard]] inline Perturbation operator*(const Jacobian<double>& map, const Perturbation& c) {
  return {map[0] * c.x + map[1] * c.v, map[2] * c.x + map[3] * c.v};
}

}  // namespace clatter::motion
