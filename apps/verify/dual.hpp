#pragma once

#include <utility>

#include "ball.hpp"

namespace verify {

/// A number and its derivative by a parameter, in balls.
struct Dual {
  Ball value, slope;

  Dual() = default;
  Dual(int constant) : value(constant), slope(0) {}              // NOLINT(google-explicit-constructor)
  Dual(Ball constant) : value(std::move(constant)), slope(0) {}  // NOLINT(google-explicit-constructor)
  Dual(Ball number, Ball derivative) : value(std::move(number)), slope(std::move(derivative)) {}

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.slope + a.slope * b.value};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Ball quotient = a.value / b.value;
    return {quotient, (a.slope - quotient * b.slope) / b.value};
  }

  friend Dual abs(const Dual& a) {
    if (a.value.is_positive()) return a;
    return a.value.is_negative() ? -a : Dual(abs(a.value), Ball::around_zero(a.slope));
  }
  friend Dual sqrt(const Dual& a) {
    const Ball root = sqrt(a.value);
    return {root, a.slope / (Ball(2) * root)};
  }
  friend Dual exp(const Dual& a) {
    const Ball power = exp(a.value);
    return {power, power * a.slope};
  }
  friend Dual log(const Dual& a) { return {log(a.value), a.slope / a.value}; }
  friend Dual asin(const Dual& a) { return {asin(a.value), a.slope / sqrt(Ball(1) - square(a.value))}; }
  friend std::pair<Dual, Dual> sin_cos(const Dual& a) {
    const auto [sine, cosine] = sin_cos(a.value);
    return {{sine, cosine * a.slope}, {cosine, -sine * a.slope}};
  }
  friend std::pair<Dual, Dual> sinh_cosh(const Dual& a) {
    const auto [sine, cosine] = sinh_cosh(a.value);
    return {{sine, cosine * a.slope}, {cosine, sine * a.slope}};
  }
  friend Dual square(const Dual& a) { return a * a; }

  [[nodiscard]] bool is_zero() const { return value.is_zero() && slope.is_zero(); }  ///< exactly, and it stays so
  [[nodiscard]] bool is_constant() const { return slope.is_zero(); }
  [[nodiscard]] bool is_positive() const { return value.is_positive(); }
  [[nodiscard]] bool is_negative() const { return value.is_negative(); }
  [[nodiscard]] double near() const { return value.near(); }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }

  /// All numbers from -radius to radius, and derivatives likewise.
  [[nodiscard]] static Dual around_zero(const Dual& radius) {
    return {Ball::around_zero(radius.value), Ball::around_zero(radius.slope)};
  }
};

}  // namespace verify
