#include "observables/harmonics/panel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/random.hpp"

namespace clatter::observables::panel_test {
namespace {

using Complex = std::complex<double>;
using Long = std::complex<long double>;

constexpr double ulp = std::numeric_limits<double>::epsilon();

/// Frequencies over the reciprocal of half a panel: slow waves, fast ones, and both sides of where the way changes.
std::vector<double> turns() {
  std::vector<double> all{0.0, 1e-30, 1e-9, 0.1, 1.0, 7.999999, 8.000001, 12.566370614359172};
  for (double turn = 0.3; turn < 1e6; turn *= 1.37) all.push_back(turn);
  return all;
}

/// Integral of e^{z s}, -half <= s <= half.
Long wave(const Long& z, long double half) {
  return std::abs(z * half) < 1e-8L ? Long(2 * half) : (std::exp(z * half) - std::exp(-z * half)) / z;
}

TEST(Panel, integrals_with_waves_are_right_to_the_rounding_of_the_motion) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    support::Random random(53, i);
    const double half = random.logarithmic(1e-6, 1e3), middle = random.uniform(-3, 3) * half;
    const double rate = random.uniform(0, 2) / half, decay = random.uniform(-2, 2) / half, phase = random.uniform(0, 6);
    const auto motion = [&](double s) {
      return std::exp(-decay * (s - middle)) * std::cos(rate * (s - middle) + phase);
    };
    const double largest = std::exp(std::abs(decay) * half);
    Panel panel(middle, half, motion);
    for (const double turn : turns()) {
      const double w = turn / half;
      const Long up = wave(Long(-decay, rate - w), half) * std::polar(1.0L, static_cast<long double>(phase)),
                 down = wave(Long(-decay, -rate - w), half) * std::polar(1.0L, -static_cast<long double>(phase));
      const Complex expected((up + down) / 2.0L), told = panel.integral(w);
      // the values are off by ulps of their own, and by the motion's 2 radians times the ulps of their instants
      EXPECT_LT(std::abs(told - expected), 8 * ulp * half * largest) << i << ' ' << turn;
    }
  }
}

TEST(Panel, of_a_parabola_has_its_closed_form) {
  Panel panel(0.0, 1.0, [](double t) { return (1 - t) * (1 + t); });
  for (const double turn : turns()) {
    if (turn < 1) continue;  // where the closed form cancels
    const double expected = 4 * (std::sin(turn) - turn * std::cos(turn)) / (turn * turn * turn);
    EXPECT_NEAR(panel.integral(turn).real(), expected, 8 * ulp) << turn;
    EXPECT_NEAR(panel.integral(turn).imag(), 0.0, 8 * ulp) << turn;
  }
}

}  // namespace
}  // namespace clatter::observables::panel_test
