#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "math/fifty_digits.hpp"
#include "support/motion.hpp"

namespace clatter::motion {

/// Expects the closed form of an arc under a force to be the solution of the equation of motion, by its Taylor series
/// in 50 digits.
inline void expect_closed_form(const Oscillator& o, const std::string& text) {
  const support::ArcStart start{0.37, -1.1, 0.137};
  const auto closed = support::motion_after<FiftyDigits>(o, start, 2.3),
             stepped = support::motion_by_taylor<FiftyDigits>(o, start, 2.3);
  const FiftyDigits size = 1 + abs(stepped.x) + abs(stepped.v) + abs(stepped.a);
  EXPECT_LT(abs(closed.x - stepped.x), 1e-38 * size) << text;
  EXPECT_LT(abs(closed.v - stepped.v), 1e-38 * size) << text;
  EXPECT_LT(abs(closed.a - stepped.a), 1e-36 * size) << text;
  EXPECT_LT(abs(closed.sine - stepped.sine) + abs(closed.cosine - stepped.cosine), 1e-40 * size) << text;
  EXPECT_LT(abs(closed.offset - (closed.x - FiftyDigits(0.37))), 1e-38 * size) << text;
}

/// Expects double to agree with 50 digits to some rounding.
inline void expect_fifty_digits(const Oscillator& o, double rounding, const std::string& text) {
  for (const double s : {1e-6, 0.03, 0.2, 0.5, 1.0, 6.0}) {
    const support::ArcStart start{0.37, -1.1, 0.137};
    const auto rounded = support::motion_after<double>(o, start, s);
    const auto exact = support::motion_after<FiftyDigits>(o, start, s);
    // a start that is off by a rounding may be so by all that the motion grows
    const double grown = o.stiffness < 0 ? std::exp(std::sqrt(-o.stiffness) * s) : 1 + s;
    const double reached = static_cast<double>(abs(exact.x) + abs(exact.v) + abs(exact.a));
    const double tolerance = rounding * (1 + reached) * grown;
    EXPECT_NEAR(rounded.x, static_cast<double>(exact.x), tolerance) << text << ", s = " << s;
    EXPECT_NEAR(rounded.v, static_cast<double>(exact.v), tolerance) << text << ", s = " << s;
    EXPECT_NEAR(rounded.offset, static_cast<double>(exact.offset), tolerance) << text << ", s = " << s;
  }
}

}  // namespace clatter::motion
