#include "math/wide_functions.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "support/random.hpp"

namespace clatter::wide_float_test {
namespace {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<150>, boost::multiprecision::et_off>;

constexpr double last_bit = 0x1p-190;

/// As the sum of doubles.
Exact exact(WideFloat x) {
  Exact sum = 0;
  for (int i = 0; i < 5; ++i) {
    const auto part = static_cast<double>(x);
    sum += Exact(part), x -= part;
  }
  EXPECT_EQ(x, 0);
  return sum;
}

/// A number with digits in all words, of a size between 10^-range and 10^range.
WideFloat any_number(std::mt19937_64& random, double range) {
  std::uniform_real_distribution<double> part(-1, 1);
  std::uniform_int_distribution<std::uint64_t> word;
  const WideFloat fraction(word(random), word(random), word(random), 0);
  return fraction * (part(random) * std::pow(10.0, range * part(random)));
}

double error_of(const WideFloat& value, const Exact& right) {
  return static_cast<double>(abs(exact(value) - right) / abs(right));
}

TEST(WideFloat, ComputesAsMoreDigitsDo) {
  std::mt19937_64 random(66);
  for (int i = 0; i < 10000; ++i) {
    const WideFloat a = any_number(random, 30), b = any_number(random, 30);
    const Exact x = exact(a), y = exact(b);
    EXPECT_LE(error_of(a * b, x * y), last_bit);
    EXPECT_LE(error_of(a / b, x / y), last_bit);
    EXPECT_LE(error_of(a + b, x + y), last_bit);
    EXPECT_LE(error_of(sqrt(abs(a)), sqrt(abs(x))), 8 * last_bit);
    EXPECT_EQ(a < b, x < y);
    EXPECT_EQ(a >= b, x >= y);
    EXPECT_EQ(exact(floor(a)), floor(x));
    EXPECT_EQ(static_cast<double>(a), static_cast<double>(x));
    EXPECT_EQ(exact(ldexp(a, 7)), ldexp(x, 7));
  }
}

TEST(WideFloat, LosesNoDigitWhereNumbersCancel) {
  std::mt19937_64 random(67);
  std::uniform_int_distribution<int> bits(6, 190);
  for (int i = 0; i < 10000; ++i) {
    const WideFloat a = any_number(random, 3), near = a * (1 + ldexp(any_number(random, 1), -bits(random)));
    EXPECT_EQ(exact(a - near), exact(a) - exact(near)) << i;
    EXPECT_EQ(a - a, 0);
  }
}

TEST(WideFloat, WholeNumbersStayWhole) {
  std::mt19937_64 random(68);
  std::uniform_int_distribution<std::int64_t> number(-(std::int64_t{1} << 52), std::int64_t{1} << 52);
  for (int i = 0; i < 10000; ++i) {
    const WideFloat a = static_cast<double>(number(random)), b = static_cast<double>(number(random) | 1);
    EXPECT_EQ(a * b / b, a);
    EXPECT_EQ((a + b) - b, a);
    EXPECT_EQ(floor(a / 8) * 8 + (a - floor(a / 8) * 8), a);
  }
  EXPECT_EQ(WideFloat(6) / 3, 2);
  EXPECT_EQ(sqrt(WideFloat(1)), 1);
}

/// A divisor whose first words are as large as can be makes every guess of a quotient's word too large.
TEST(WideFloat, DividesByNumbersThatMisleadTheGuessOfAWord) {
  constexpr std::uint64_t all = ~std::uint64_t{0}, half = std::uint64_t{1} << 63;
  for (const std::uint64_t low : {std::uint64_t{0}, std::uint64_t{1}, half, all})
    for (const std::uint64_t middle : {std::uint64_t{0}, std::uint64_t{1}, half, all})
      for (const std::uint64_t high : {half, half | 1, all - 1, all}) {
        const WideFloat divisor(high, middle, low, 0), number(half | middle, low, all, 0);
        EXPECT_LE(error_of(number / divisor, exact(number) / exact(divisor)), last_bit);
        EXPECT_EQ(divisor / divisor, 1);
      }
}

TEST(WideFloat, FunctionsHaveFiftyDigits) {
  std::mt19937_64 random(69);
  constexpr double fifty_digits = 0x1p-172;
  for (int i = 0; i < 300; ++i) {
    const WideFloat a = any_number(random, 2), b = any_number(random, 2), small = any_number(random, 12) * 1e-12;
    const Exact x = exact(a), y = exact(b), s = exact(small);
    EXPECT_LE(abs(exact(sin(a)) - sin(x)), fifty_digits) << x;
    EXPECT_LE(abs(exact(cos(a)) - cos(x)), fifty_digits) << x;
    EXPECT_LE(abs(exact(sin(1e12 * a)) - sin(exact(1e12 * a))), fifty_digits) << x;
    EXPECT_LE(error_of(sin(small), sin(s)), fifty_digits);
    EXPECT_LE(error_of(tan(small), tan(s)), fifty_digits);
    EXPECT_LE(error_of(exp(a), exp(x)), fifty_digits) << x;
    EXPECT_LE(error_of(expm1(small), expm1(s)), fifty_digits);
    EXPECT_LE(abs(exact(log(abs(a))) - log(abs(x))), fifty_digits * (1 + abs(log(abs(x)))));
    EXPECT_LE(error_of(log1p(small), log1p(s)), fifty_digits);
    EXPECT_LE(error_of(atan2(a, b), atan2(x, y)), fifty_digits);
    EXPECT_LE(error_of(atan(a), atan(x)), fifty_digits);
    EXPECT_LE(error_of(pow(abs(a), b / 50), pow(abs(x), y / 50)), fifty_digits);
  }
  EXPECT_LE(error_of(pi<WideFloat>(), 4 * atan(Exact(1))), last_bit * 4);
  EXPECT_LE(error_of(log(WideFloat(2)), log(Exact(2))), last_bit * 256);
}

TEST(WideFloat, ReachesInfinityAndNaNAsDoublesDo) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const WideFloat far = infinite, none = 0, some = WideFloat(1) / 3;
  EXPECT_EQ(far + some, far);
  EXPECT_EQ(some - far, -far);
  EXPECT_EQ(-2 * far, -far);
  EXPECT_EQ(some / far, none);
  EXPECT_EQ(some / none, far);
  EXPECT_EQ(-some / none, -far);
  EXPECT_EQ(none * some + none, none);
  EXPECT_EQ(exp(-far), none);
  EXPECT_EQ(sqrt(none), none);
  EXPECT_GT(far, std::numeric_limits<WideFloat>::max());
  EXPECT_LT(-far, some);
  for (const WideFloat& undefined : {far - far, none * far, none / none, sqrt(-some), sin(far)}) {
    EXPECT_TRUE(isnan(undefined));
    EXPECT_FALSE(undefined == undefined);
    EXPECT_FALSE(undefined < some || undefined > some);
  }
  EXPECT_FALSE(isfinite(far));
  EXPECT_TRUE(std::isnan(static_cast<double>(far - far)));
}

}  // namespace
}  // namespace clatter::wide_float_test
