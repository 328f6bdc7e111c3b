#pragma once

#include <array>
#include <cmath>

#include "scene/force_shape.hpp"

namespace clatter {
inline namespace scene {

/// Compiled once, with all optimisations, since code that is compiled with fewer calls it, too.
extern template std::array<double, 5> ForceOrders<double>::derivatives(const SineCosine<double>&) const;

/// A force at a phase, and its derivative by that.
template <class Number>
struct PhasedForce {
  Number value, slope;
};

/// That of f s(theta) without pieces; theta in rad.
template <class Number>
[[nodiscard]] PhasedForce<Number> force_at(const Number& f, const BasicForceShape<Number>& shape, const Number& theta) {
  using std::cos, std::sin;
  const Number sine = sin(theta), cosine = cos(theta);
  if (!shape.has_orders()) return {f * sine, f * cosine};
  const auto s = shape.orders.derivatives({sine, cosine});
  return {f * s[0], f * s[1]};
}

}  // namespace scene
}  // namespace clatter
