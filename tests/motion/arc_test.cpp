#include "motion/arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/fifty_digits.hpp"
#include "motion/arc_bounds.hpp"
#include "support/motion.hpp"

namespace clatter::motion::arc_test {
namespace {

std::vector<Oscillator> oscillators() {
  std::vector<Oscillator> all;
  for (double h : {0.0, 1e-300, 1e-9, 0.1, 0.5, 1 - 1e-12, 1.0, 1 + 1e-12, 1.5, 10.0})
    for (double nu : {0.3, 1 - 1e-9, 1.0, std::nextafter(1.0, 2.0), 1.04, 2.7}) all.push_back({h, -1.3, nu, 0.2});
  return all;
}

TEST(Arc, closed_form_is_the_solution_of_the_equation_of_motion) {
  for (const Oscillator& o : oscillators()) {
    const support::ArcStart start{0.37, -1.1, 0.137};
    const auto closed = motion_after<FiftyDigits>(o, start, 4.3),
               stepped = motion_by_taylor<FiftyDigits>(o, start, 4.3);
    EXPECT_LT(abs(closed.x - stepped.x), 1e-40) << "h = " << o.damping << ", nu = " << o.frequency;
    EXPECT_LT(abs(closed.v - stepped.v), 1e-40) << "h = " << o.damping << ", nu = " << o.frequency;
  }
}

TEST(Arc, double_agrees_with_fifty_digits_for_every_damping_and_frequency) {
  for (const Oscillator& o : oscillators())
    for (double s : {1e-6, 0.2, 1.0, 6.0, 40.0}) {
      const support::ArcStart start{0.37, -1.1, 0.137};
      const auto rounded = motion_after<double>(o, start, s);
      const auto exact = motion_after<FiftyDigits>(o, start, s);
      // natural scale: the start and the response, which resonance lets grow to f s/2; the argument of a sine rounds to
      // s ulps
      const double scale = 2 + 1.3 * std::max(1.0, s / 2), tolerance = 1e-15 * (8 + s) * scale;
      EXPECT_NEAR(rounded.x, static_cast<double>(exact.x), tolerance)
          << "h = " << o.damping << ", nu = " << o.frequency << ", s = " << s;
      EXPECT_NEAR(rounded.v, static_cast<double>(exact.v), tolerance)
          << "h = " << o.damping << ", nu = " << o.frequency << ", s = " << s;
    }
}

TEST(Arc, secular_resonance_has_its_closed_form) {
  // h = 0, nu = 1, f = 1 from rest: x = -(tau cos tau - sin tau)/2
  for (double tau : {0.1, 1.0, 10.0, 100.0, 200 * 3.14159}) {
    const auto m = support::motion_after<double>({0.0, 1.0, 1.0, 0.0}, {0, 0, 0}, tau);
    const double scale = tau / 2;
    EXPECT_NEAR(m.x, -(tau * std::cos(tau) - std::sin(tau)) / 2, 1e-15 * scale * 2 + 1e-16 * tau * scale);
    EXPECT_NEAR(m.v, tau * std::sin(tau) / 2, 1e-15 * scale * 2 + 1e-16 * tau * scale);
  }
}

TEST(Arc, resonance_is_approached_continuously) {
  const double tau = 100 * 2 * 3.141592653589793;
  const double limit = support::motion_after<double>({0.0, 1.0, 1.0, 0.0}, {0, 0, 0}, tau).x;
  for (double h : {1e-300, 1e-100, 1e-18})
    for (double nu : {1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0)})
      EXPECT_NEAR(support::motion_after<double>({h, 1.0, nu, 0.0}, {0, 0, 0}, tau).x / limit, 1.0, 1e-12);
}

TEST(Arc, heavy_damping_neither_overflows_nor_loses_the_slow_motion) {
  for (double h : {1.0, 10.0, 1000.0}) {
    const Oscillator o{h, 0.0, 1.0, 0.0};
    for (double s : {1.0, 100.0, 5000.0}) {
      const auto rounded = support::motion_after<double>(o, {1, 0, 0}, s);
      const auto exact = support::motion_after<FiftyDigits>(o, {1, 0, 0}, s);
      EXPECT_TRUE(std::isfinite(rounded.x));
      // relative to the motion itself: the exponent of the slow decay s/(2h) rounds to half an ulp of itself
      if (exact.x > 1e-290) {
        EXPECT_NEAR(rounded.x / static_cast<double>(exact.x), 1.0, 1e-15 * (8 + s / h)) << "h = " << h << ", s = " << s;
      }
    }
  }
}

TEST(Arc, rise_of_a_short_flight_keeps_its_relative_accuracy) {
  const Oscillator o{0.1, 1.0, 1.5, 0.0};
  for (double s : {1e-3, 1e-6, 1e-12}) {
    const auto rounded = support::motion_after<double>(o, {0.5, -0.3, 0.2}, s);
    const auto exact = support::motion_after<FiftyDigits>(o, {0.5, -0.3, 0.2}, s);
    EXPECT_NEAR(rounded.offset / static_cast<double>(exact.offset), 1.0, 4e-16);
  }
}

TEST(Arc, rise_keeps_its_digits_for_every_length_of_flight) {
  for (const Oscillator& o : oscillators())
    for (double s : {1e-9, 1e-4, 0.02, 0.3, 2.0}) {
      const auto rounded = support::motion_after<double>(o, {0.37, -1.1, 0.137}, s);
      const auto exact = support::motion_after<FiftyDigits>(o, {0.37, -1.1, 0.137}, s);
      // v s with |v| = 1.1, made of a transient and a response of up to 1.3 * 8 each
      EXPECT_NEAR(rounded.offset, static_cast<double>(exact.offset), 2e-14 * std::min(s, 1.0))
          << "h = " << o.damping << ", nu = " << o.frequency;
    }
}

TEST(Arc, derivative_bounds_hold_and_are_not_slack) {
  // free undamped motion has |x^(k)| <= its amplitude, the steady response nu^k times its own
  const ArcConstants<double, Effects{Damping::none, Forcing::none}> free({0, 0, 1, 0});
  for (int derivative : {0, 1}) {
    const double bound = sixth_bound(free, {0, 0.6, 0.8, -0.6, 0, 1, 0.6, 0.8}, 2.0, derivative) / 64;
    EXPECT_GE(bound, 1.0);
    EXPECT_LE(bound, 1.5);
  }
  const ArcConstants<double, Effects{Damping::light, Forcing::regular}> forced({0.1, 1.0, 2.0, 0.0});
  for (int derivative : {0, 1})
    EXPECT_NEAR(sixth_bound(forced, {0, 1, 1, 0, 0, 1}, 0.5, derivative) * 64,
                std::pow(2.0, 6 + derivative) * forced.response.amplitude, 1e-12);
}

/// The k-th derivative of an arc at s, from differences in 50 digits.
template <Effects E>
double derivative_at(const Arc<FiftyDigits, E>& arc, double s, int k) {
  const FiftyDigits d("1e-5");
  FiftyDigits sum = 0, binomial = 1;
  for (int i = 0; i <= k; ++i) {
    sum += (i % 2 == 0 ? binomial : -binomial) * arc.at(s + (FiftyDigits(k) / 2 - i) * d).x;
    binomial = binomial * (k - i) / (i + 1);
  }
  for (int i = 0; i < k; ++i) sum /= d;
  return static_cast<double>(sum);
}

TEST(Arc, derivative_bounds_hold_for_every_kind_of_motion) {
  for (const Oscillator& o : oscillators())
    with_any_stops(o, [&]<Effects effects>() {
      const ArcConstants<FiftyDigits, effects.arc()> constants(o);
      const Arc<FiftyDigits, effects.arc()> arc(
          constants, {0, FiftyDigits(0.37), FiftyDigits(-1.1), 0, FiftyDigits(0.6), FiftyDigits(0.8)});
      const FiftyDigits span = 1.5;
      for (double from : {0.5, 3.0})
        for (int derivative : {0, 1}) {
          const double bound =
              static_cast<double>(sixth_bound(constants, arc.at(from), span, derivative)) / std::pow(1.5, 6);
          for (int eighth = 0; eighth <= 12; ++eighth)
            EXPECT_LE(std::abs(derivative_at(arc, from + eighth / 8.0, 6 + derivative)), bound * (1 + 1e-8))
                << "h = " << o.damping << ", nu = " << o.frequency;
        }
    });
}

TEST(Arc, the_rest_of_a_transient_is_known_far_below_the_rounding_of_the_whole) {
  // 40 time constants on: the acceleration of a slow response and a faded transient to relative accuracy
  const Oscillator o{0.5, 1.0, 1e-9, 0.0};
  const auto rounded = support::motion_after<double>(o, {1.0, 0.0, 0.2}, 80.0);
  const auto exact = support::motion_after<FiftyDigits>(o, {1.0, 0.0, 0.2}, 80.0);
  EXPECT_NEAR(rounded.free_x / static_cast<double>(exact.free_x), 1.0, 1e-13);
  EXPECT_NEAR(rounded.a / static_cast<double>(exact.a), 1.0, 1e-13);
}

}  // namespace
}  // namespace clatter::motion::arc_test
