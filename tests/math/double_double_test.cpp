#include "math/double_double.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "math/fifty_digits.hpp"
#include "support/random.hpp"

namespace clatter::double_double_test {
namespace {

FiftyDigits exact(const DoubleDouble& x) { return FiftyDigits(x.high()) + FiftyDigits(x.low()); }

/// A number with digits in both parts, of a size between 10^-range and 10^range.
DoubleDouble any_number(std::mt19937_64& random, double range) {
  std::uniform_real_distribution<double> part(-1, 1);
  const double high = part(random) * std::pow(10.0, range * part(random));
  return DoubleDouble::sum(high, high * part(random) * std::ldexp(1.0, -54));
}

constexpr double few_roundings = 16 * 4.930380657631324e-32;

double error_of(const DoubleDouble& value, const FiftyDigits& right) {
  return static_cast<double>(abs(exact(value) - right) / abs(right));
}

TEST(DoubleDouble, ComputesAsFiftyDigitsDo) {
  std::mt19937_64 random(61);
  for (int i = 0; i < 20000; ++i) {
    const DoubleDouble a = any_number(random, 30), b = any_number(random, 30);
    const FiftyDigits x = exact(a), y = exact(b);
    EXPECT_LE(error_of(a * b, x * y), few_roundings);
    EXPECT_LE(error_of(a / b, x / y), few_roundings);
    EXPECT_LE(error_of(sqrt(abs(a)), sqrt(abs(x))), few_roundings);
    EXPECT_LE(abs(exact(a + b) - (x + y)), few_roundings * (abs(x) + abs(y)));
    const DoubleDouble near = a * (1 + b * std::ldexp(1.0, -60));
    EXPECT_LE(abs(exact(a - near) - (x - exact(near))), few_roundings * abs(x - exact(near)));  // no digit is lost
    EXPECT_EQ(a < b, x < y);
    EXPECT_EQ(a >= b, x >= y);
    EXPECT_EQ(exact(floor(a)), floor(x));
  }
}

/// Any double but NaN: every exponent is as likely, subnormal numbers included; sometimes 0 or infinite.
double any_double(std::mt19937_64& random) {
  for (;;) {
    const double value = std::bit_cast<double>(random());
    const std::uint64_t pick = random() % 64;
    if (pick == 0) return std::copysign(0.0, value);
    if (pick == 1) return std::copysign(std::numeric_limits<double>::infinity(), value);
    if (pick < 8)
      return std::copysign(std::ldexp(std::bit_cast<double>(random() >> 12 | 0x3ffull << 52), -1070), value);
    if (!std::isnan(value)) return value;
  }
}

TEST(DoubleDouble, FusesLikeTheStandardLibrary) {
  std::mt19937_64 random(60);
  for (int i = 0; i < 400000; ++i) {
    const double a = any_double(random), b = any_double(random), p = a * b;
    for (const double c : {-p, any_double(random), std::nextafter(-p, 0.0)}) {
      const double one = math::detail::fused(a, b, c), other = std::fma(a, b, c);
      if (std::isnan(other)) {
        EXPECT_TRUE(std::isnan(one)) << a << ' ' << b << ' ' << c;
      } else {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(one), std::bit_cast<std::uint64_t>(other)) << a << ' ' << b << ' ' << c;
      }
    }
  }
}

TEST(DoubleDouble, ResultsBeyondDoubleAreThoseOfDouble) {
  std::mt19937_64 random(63);
  for (int i = 0; i < 100000; ++i) {
    const double a = any_double(random), b = any_double(random);
    const DoubleDouble x = a, y = b;
    for (const auto& [value, right] : {std::pair{x + y, a + b}, {x - y, a - b}, {x * y, a * b}, {x / y, a / b}}) {
      if (std::isfinite(right)) continue;
      EXPECT_FALSE(isfinite(value)) << a << ' ' << b;
      EXPECT_EQ(isnan(value), std::isnan(right)) << a << ' ' << b;
      EXPECT_EQ(std::signbit(value.high()) || isnan(value), std::signbit(right) || isnan(value)) << a << ' ' << b;
    }
  }
}

TEST(DoubleDouble, FunctionsHaveAllDigits) {
  std::mt19937_64 random(62);
  for (int i = 0; i < 3000; ++i) {
    const DoubleDouble a = any_number(random, 2), b = any_number(random, 2), small = any_number(random, 12) * 1e-12;
    const FiftyDigits x = exact(a), y = exact(b), s = exact(small);
    const double size = std::max(1.0, std::abs(a.high()));
    EXPECT_LE(abs(exact(sin(a)) - sin(x)), few_roundings * size) << a.high();
    EXPECT_LE(abs(exact(cos(a)) - cos(x)), few_roundings * size) << a.high();
    EXPECT_LE(error_of(sin(small), sin(s)), few_roundings);
    EXPECT_LE(error_of(exp(a), exp(x)), few_roundings * size) << a.high();
    EXPECT_LE(error_of(expm1(small), expm1(s)), few_roundings);
    EXPECT_LE(abs(exact(log(abs(a))) - log(abs(x))), few_roundings * (1 + abs(log(abs(x)))));
    EXPECT_LE(error_of(log1p(small), log1p(s)), few_roundings);
    EXPECT_LE(error_of(atan2(a, b), atan2(x, y)), few_roundings);
    EXPECT_LE(error_of(atan(a), atan(x)), few_roundings);
    EXPECT_LE(error_of(tan(small), tan(s)), few_roundings);
  }
  EXPECT_LE(error_of(pi<DoubleDouble>(), pi<FiftyDigits>()), few_roundings);
}

TEST(DoubleDouble, ReachesInfinityWithoutNaN) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const DoubleDouble far = infinite;
  EXPECT_EQ(far + 1, far);
  EXPECT_EQ(1 - far, -far);
  EXPECT_EQ(2 * far, far);
  EXPECT_EQ(1 / far, DoubleDouble(0));
  EXPECT_EQ(DoubleDouble(1) / 0, far);
  EXPECT_EQ(exp(-far), DoubleDouble(0));
  EXPECT_GT(far, std::numeric_limits<DoubleDouble>::max());
  EXPECT_TRUE(isnan(far - far));
  EXPECT_FALSE(isfinite(far));
  EXPECT_EQ(sqrt(DoubleDouble(0)), DoubleDouble(0));
}

}  // namespace
}  // namespace clatter::double_double_test
