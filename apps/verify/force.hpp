#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "dual.hpp"

namespace verify {

/// The part A sin(j theta) + B cos(j theta) of a force.
template <class Number>
struct BasicOrder {
  int j;
  Number in_phase, quadrature;  ///< A and B

  /// The first derivatives by theta, at a phase of which sine and cosine of j theta are given.
  template <std::size_t count>
  [[nodiscard]] std::array<Number, count> derivatives(const Number& sine, const Number& cosine) const {
    std::array<Number, count> all;
    Number value = in_phase * sine + quadrature * cosine, turned = in_phase * cosine - quadrature * sine;
    for (std::size_t i = 0; i < count; ++i) {
      all[i] = value;
      value = Number(j) * turned, turned = Number(-j) * all[i];
    }
    return all;
  }
};

/// A force of several orders of a phase theta = nu tau + phase; without any there is none.
template <class Number>
struct BasicForce {
  std::vector<BasicOrder<Number>> orders;

  [[nodiscard]] bool is_zero() const { return orders.empty(); }
  /// Whether it is A sin(theta).
  [[nodiscard]] bool is_sine() const {
    return orders.size() == 1 && orders[0].j == 1 && orders[0].quadrature.is_zero();
  }
  /// Whether half a period later it is its opposite.
  [[nodiscard]] bool is_odd() const {
    return std::ranges::all_of(orders, [](const auto& order) { return order.j % 2 != 0; });
  }
  [[nodiscard]] int highest() const {
    int most = 0;
    for (const auto& order : orders) most = std::max(most, order.j);
    return most;
  }
  /// It and its first derivative by theta, at a phase.
  [[nodiscard]] std::pair<Number, Number> at(const Number& theta) const {
    std::pair<Number, Number> sum{Number(0), Number(0)};
    for (const auto& order : orders) {
      const auto [sine, cosine] = sin_cos(Number(order.j) * theta);
      const auto [value, slope] = order.template derivatives<2>(sine, cosine);
      sum = {sum.first + value, sum.second + slope};
    }
    return sum;
  }
  /// Bound of the amount of its derivative by theta.
  [[nodiscard]] Number steepest() const {
    Number sum(0);
    for (const auto& [j, A, B] : orders) sum = sum + Number(j) * (B.is_zero() ? abs(A) : sqrt(square(A) + square(B)));
    return sum;
  }
  /// The sum of the squares of its orders, 0 if it vanishes.
  [[nodiscard]] Number squares() const {
    Number sum(0);
    for (const auto& order : orders) sum = sum + square(order.in_phase) + square(order.quadrature);
    return sum;
  }
  /// The same force on a mass that is larger.
  [[nodiscard]] BasicForce over(const Number& mass) const {
    BasicForce same = *this;
    for (auto& order : same.orders) order.in_phase = order.in_phase / mass, order.quadrature = order.quadrature / mass;
    return same;
  }
};

[[nodiscard]] inline BasicForce<Ball> values_of(const BasicForce<Dual>& moving) {
  BasicForce<Ball> force;
  for (const auto& [j, A, B] : moving.orders) force.orders.push_back({j, A.value, B.value});
  return force;
}

}  // namespace verify
