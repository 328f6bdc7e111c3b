#pragma once

#include <cmath>
#include <cstddef>

#include "scene/force_shape.hpp"
#include "support/random.hpp"

namespace clatter::support {

/// A random force of several orders, the sum of whose sizes is 1: some fall as 1/j, some are odd or even alone, or one.
[[nodiscard]] inline ForceShape any_force_orders(Random& random) {
  ForceShape shape{.waveform = Waveform::orders};
  auto& orders = shape.orders.of;
  const std::size_t highest = static_cast<std::size_t>(random.uniform(1, 9)), step = random.happens(0.3) ? 2 : 1;
  const bool falls = random.happens(0.5);
  for (std::size_t j = random.happens(0.7) ? 1 : highest; j <= highest; j += step) {
    const double size = random.uniform(0.1, 1) / (falls ? static_cast<double>(j) : 1.0), phase = random.uniform(0, 7);
    orders[j - 1] = {size * std::cos(phase), random.happens(0.3) ? 0.0 : size * std::sin(phase)};
  }
  const double sum = shape.orders.most_of(0);
  for (ForceOrder<double>& order : orders) order = {order.in_phase / sum, order.quadrature / sum};
  return shape;
}

}  // namespace clatter::support
