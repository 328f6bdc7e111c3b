#include "lanes/functions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lanes/vector.hpp"
#include "math/bernstein.hpp"

namespace clatter::lanes::functions_test {
namespace {

using V = Pair<xsimd::sse2>;

/// 0 ... 2 in steps that are no multiples of each other, the ends included.
template <class Look>
void over_the_range(const Look& look) {
  constexpr int count = 40000;
  for (int i = 0; i <= count; ++i) look(longest_angle * i / count);
  for (int i = 1; i < 60; ++i) look(std::ldexp(1.9, -i));
}

double first(const V& y) { return y.first.get(0); }

TEST(LaneFunctions, turns_are_known_to_two_ulps_of_1) {
  double worst = 0;
  over_the_range([&](double x) {
    const auto [sine, less] = short_turn(V(x));
    const long double angle = x, half = std::sin(angle / 2);
    worst = std::max(worst, static_cast<double>(std::abs(first(sine) - std::sin(angle))));
    worst = std::max(worst, static_cast<double>(std::abs(first(less) + 2 * half * half)));
  });
  EXPECT_LE(worst, 2 * epsilon<double>());
  EXPECT_GT(worst, 0);
}

TEST(LaneFunctions, small_angles_keep_their_digits) {
  // the time to a contact soon after the last one is relative to itself, so both have to be accurate to themselves
  over_the_range([](double x) {
    if (x == 0 || x > 0.1) return;
    const auto [sine, less] = short_turn(V(x));
    EXPECT_NEAR(first(sine) / std::sin(x), 1, 4 * epsilon<double>());
    EXPECT_NEAR(first(less) / (-2 * std::sin(x / 2) * std::sin(x / 2)), 1, 4 * epsilon<double>());
  });
}

TEST(LaneFunctions, decay_is_known_to_two_ulps_of_1) {
  double worst = 0;
  over_the_range([&](double x) {
    worst = std::max(worst,
                     static_cast<double>(std::abs(first(short_decay(V(x))) - std::exp(-static_cast<long double>(x)))));
  });
  EXPECT_LE(worst, 2 * epsilon<double>());
}

/// The propagator of k = 0 or -1, damped or not, at a time, by the modes in long double.
struct Modes {
  long double a, b, c;
  Modes(long double s, long double h, long double k) {
    const long double root = std::sqrt(h * h - k);
    b = std::exp(-h * s) * (root > 0 ? std::sinh(root * s) / root : s);
    const long double mean = std::exp(-h * s) * std::cosh(root * s);
    a = mean + h * b, c = mean - h * b;
  }
};

TEST(LaneFunctions, propagators_of_two_exponentials_are_known_to_four_ulps_of_their_size) {
  double worst = 0;
  for (const double k : {0.0, -1.0})
    for (const double h : {0.0, 1e-9, 0.01, 0.3, 0.9}) {
      const double rate = std::max(h + std::sqrt(h * h - k), 0.1);
      over_the_range([&](double x) {
        const double s = 0.9 * x / rate;
        const auto found = short_propagator(V(s), V(h), V(k - h * h));
        const Modes modes(s, h, k - (std::fma(h, h, -h * h)));  // of k - h^2 as it is rounded
        const double size = static_cast<double>(std::max({modes.a, modes.b, 1.0L})) * epsilon<double>();
        worst = std::max({worst, static_cast<double>(std::abs(first(found.a) - modes.a)) / size,
                          static_cast<double>(std::abs(first(found.b) - modes.b)) / size,
                          static_cast<double>(std::abs(first(found.c) - modes.c)) / size});
      });
    }
  EXPECT_LE(worst, 4);
  EXPECT_GT(worst, 0);
}

TEST(LaneFunctions, a_flight_of_no_length_changes_nothing) {
  const auto p = short_propagator(V(0.0), V(0.3), V(-1.09));
  EXPECT_EQ(first(p.a), 1);
  EXPECT_EQ(first(p.b), 0);
  EXPECT_EQ(first(p.c), 1);
}

TEST(LaneFunctions, the_second_divided_difference_of_decay_is_known_to_two_ulps_of_1) {
  double worst = 0;
  over_the_range([&](double x) {
    const long double z = x;
    const long double exact =
        z < 1e-3L ? 0.5L - z / 6 + z * z / 24 - z * z * z / 120 + z * z * z * z / 720 : (z + std::expm1(-z)) / (z * z);
    worst = std::max(worst, static_cast<double>(std::abs(first(short_second_divided_decay(V(x))) - exact)));
  });
  EXPECT_LE(worst, 2 * epsilon<double>());
}

TEST(Enclosure, is_nan_if_anything_in_it_is_and_stays_so) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int broken = -1; broken < 7; ++broken) {
    const auto input = [&](int i, double y) { return V(i == broken ? nan : y); };
    const HermiteData<V> ends{input(0, 0.1), input(1, 0.5), input(2, -0.2),
                              input(3, 0.3), input(4, 0.1), input(5, -0.3)};
    Interval<V> range = enclosure(hermite(ends), input(6, 1e-3));
    range.include(V(0.3));
    EXPECT_EQ(std::isnan(first(range.low)), broken >= 0) << broken;
    EXPECT_EQ(std::isnan(first(range.high)), broken >= 0) << broken;
  }
}

TEST(LaneFunctions, nothing_passes_without_time) {
  EXPECT_EQ(first(short_turn(V(0.0)).sine), 0);
  EXPECT_EQ(first(short_turn(V(0.0)).cosine_minus_one), 0);
  EXPECT_EQ(first(short_decay(V(0.0))), 1);
}

}  // namespace
}  // namespace clatter::lanes::functions_test
