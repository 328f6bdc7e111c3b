#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

namespace clatter {
inline namespace math {

/// A number with its derivatives by n variables, exact to rounding (forward-mode automatic differentiation: Griewank
/// and Walther 2008). The physics runs on it as on any other number; comparisons see the value alone. As T it may have
/// another Dual, which gives second derivatives.
template <class T, std::size_t n>
struct Dual {
  T value{};
  std::array<T, n> slope{};  ///< [variable]: derivative

  Dual() noexcept = default;  // said, as g++ 12 fails to find it out of a Dual of a Dual
  template <class U>
  requires std::convertible_to<U, T> Dual(const U& constant) : value(static_cast<T>(constant)) {}
  /// A variable: its derivative by itself is 1.
  Dual(const T& at, std::size_t variable) : value(at) { slope[variable] = T(1); }

  /// Without its derivatives.
  explicit operator double() const { return static_cast<double>(value); }

  [[nodiscard]] bool is_constant() const {
    for (const T& by : slope) {
      if (by != T(0)) return false;
      if constexpr (requires { by.is_constant(); })
        if (!by.is_constant()) return false;
    }
    return true;
  }

  friend Dual operator-(const Dual& x) { return chained(-x.value, T(-1), x); }
  friend Dual operator+(const Dual& x, const Dual& y) {
    Dual sum(x.value + y.value);
    for (std::size_t i = 0; i < n; ++i) sum.slope[i] = x.slope[i] + y.slope[i];
    return sum;
  }
  friend Dual operator-(const Dual& x, const Dual& y) {
    Dual difference(x.value - y.value);
    for (std::size_t i = 0; i < n; ++i) difference.slope[i] = x.slope[i] - y.slope[i];
    return difference;
  }
  friend Dual operator*(const Dual& x, const Dual& y) {
    Dual product(x.value * y.value);
    for (std::size_t i = 0; i < n; ++i) product.slope[i] = x.slope[i] * y.value + x.value * y.slope[i];
    return product;
  }
  friend Dual operator/(const Dual& x, const Dual& y) {
    Dual quotient(x.value / y.value);
    for (std::size_t i = 0; i < n; ++i) quotient.slope[i] = (x.slope[i] - quotient.value * y.slope[i]) / y.value;
    return quotient;
  }
  Dual& operator+=(const Dual& y) { return *this = *this + y; }
  Dual& operator-=(const Dual& y) { return *this = *this - y; }
  Dual& operator*=(const Dual& y) { return *this = *this * y; }

  friend bool operator==(const Dual& x, const Dual& y) { return x.value == y.value; }
  friend auto operator<=>(const Dual& x, const Dual& y) { return x.value <=> y.value; }

  friend Dual sin(const Dual& x) {
    using std::cos, std::sin;
    return chained(sin(x.value), cos(x.value), x);
  }
  friend Dual cos(const Dual& x) {
    using std::cos, std::sin;
    return chained(cos(x.value), -sin(x.value), x);
  }
  friend Dual tan(const Dual& x) {
    using std::tan;
    const T y = tan(x.value);
    return chained(y, T(1) + y * y, x);
  }
  friend Dual exp(const Dual& x) {
    using std::exp;
    const T y = exp(x.value);
    return chained(y, y, x);
  }
  friend Dual expm1(const Dual& x) {
    using std::exp, std::expm1;
    return chained(expm1(x.value), exp(x.value), x);
  }
  friend Dual log(const Dual& x) {
    using std::log;
    return chained(log(x.value), T(1) / x.value, x);
  }
  friend Dual sqrt(const Dual& x) {
    using std::sqrt;
    const T y = sqrt(x.value);
    if (x.is_constant()) return y;  // at 0, too
    return chained(y, T(1) / (T(2) * y), x);
  }
  friend Dual atan(const Dual& x) {
    using std::atan;
    return chained(atan(x.value), T(1) / (T(1) + x.value * x.value), x);
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const T square = x.value * x.value + y.value * y.value;
    Dual angle(atan2(y.value, x.value));
    for (std::size_t i = 0; i < n; ++i) angle.slope[i] = (x.value * y.slope[i] - y.value * x.slope[i]) / square;
    return angle;
  }
  friend Dual hypot(const Dual& x, const Dual& y) {
    using std::hypot;
    Dual length(hypot(x.value, y.value));
    for (std::size_t i = 0; i < n; ++i) length.slope[i] = (x.value * x.slope[i] + y.value * y.slope[i]) / length.value;
    return length;
  }
  friend Dual fma(const Dual& x, const Dual& y, const Dual& z) {
    using std::fma;
    Dual sum(fma(x.value, y.value, z.value));
    for (std::size_t i = 0; i < n; ++i) sum.slope[i] = x.slope[i] * y.value + x.value * y.slope[i] + z.slope[i];
    return sum;
  }
  friend Dual abs(const Dual& x) { return x.value < T(0) ? -x : x; }

 private:
  /// A function of x by the chain rule, from its value and derivative.
  static Dual chained(const T& value, const T& derivative, const Dual& x) {
    Dual y(value);
    for (std::size_t i = 0; i < n; ++i) y.slope[i] = derivative * x.slope[i];
    return y;
  }
};

}  // namespace math
}  // namespace clatter

/// Digits and bounds are those of the value.
template <class T, std::size_t n>
class std::numeric_limits<clatter::Dual<T, n>> : public std::numeric_limits<T> {};
