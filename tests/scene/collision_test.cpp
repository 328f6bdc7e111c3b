#include "scene/collision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/dual.hpp"
#include "math/fifty_digits.hpp"
#include "support/random.hpp"

namespace clatter::collision_test {
namespace {

/// Speed with which a mass leaves a stop of stiffness 1, beginning with speed 1: x'' + 2 zeta x' + x = 0 from (0, 1) on
/// until the force x + 2 zeta x' is 0, found by bisection of the motion in 50 digits. zeta isn't 1.
FiftyDigits speed_after(const FiftyDigits& zeta) {
  const FiftyDigits square = zeta * zeta - 1, rate = sqrt(abs(square));
  struct State {
    FiftyDigits x, v;
  };
  const auto at = [&](const FiftyDigits& t) -> State {
    const FiftyDigits grown = exp((square > 0 ? rate - zeta : -zeta) * t), decayed = exp(-(rate + zeta) * t);
    const FiftyDigits s = square > 0 ? (grown - decayed) / 2 : grown * sin(rate * t),
                      c = square > 0 ? (grown + decayed) / 2 : grown * cos(rate * t);
    return {s / rate, c - zeta * s / rate};
  };
  const auto pushes = [&](const FiftyDigits& t) {
    const auto [x, v] = at(t);
    return x + 2 * zeta * v > 0;
  };
  FiftyDigits low = 0, high = 4;  // a contact lasts at most pi
  for (int i = 0; i < 180; ++i) {
    const FiftyDigits middle = (low + high) / 2;
    (pushes(middle) ? low : high) = middle;
  }
  return -at(low).v;
}

/// Shares of the speed from nearly 0 to nearly 1, many of them where the formula changes: around exp(-2), and where
/// the series about it begins and ends.
std::vector<double> shares() {
  std::vector<double> all{1e-300, 1e-12, std::exp(-2.0), std::nextafter(std::exp(-2.0), 1.0), 1 - 1e-12};
  for (const double zeta : {0.75, 1.25})
    for (const double shift : {-1e-15, 0.0, 1e-15}) all.push_back(restitution_of(zeta + shift));
  support::Random random(55, 0);
  for (int i = 0; i < 200; ++i) all.push_back(random.uniform(1e-3, 1.0));
  for (int i = 0; i < 100; ++i) all.push_back(std::exp(-2 + random.sign() * random.logarithmic(1e-15, 0.3)));
  return all;
}

TEST(Collision, a_stop_of_the_inverted_damping_leaves_that_share_of_the_speed_in_fifty_digits) {
  for (const double R : shares()) {
    if (R < 1e-3) continue;  // there the motion is too steep for the bisection
    const FiftyDigits zeta = damping_ratio_of(FiftyDigits(R));
    if (abs(zeta - 1) < 1e-16) continue;  // where the motion above loses all digits
    // near zeta = 1 the motion above is 0/0, and loses as many digits as 1 - zeta has zeros
    const double allowed = std::max(1e-44, 1e-46 / std::abs(static_cast<double>(zeta - 1)));
    EXPECT_LT(abs(speed_after(zeta) / FiftyDigits(R) - 1), allowed) << R;
  }
}

TEST(Collision, damping_in_double_is_that_in_fifty_digits) {
  for (const double R : shares()) {
    const FiftyDigits exact = damping_ratio_of(FiftyDigits(R));
    // the logarithm of R has a relative error of some roundings, and zeta is a power of R where that is large
    const double roundings = 8 + std::abs(std::log(R));
    EXPECT_LT(abs(damping_ratio_of(R) / exact - 1), roundings * std::numeric_limits<double>::epsilon()) << R;
  }
}

TEST(Collision, critical_damping_leaves_the_inverse_square_of_e_and_none_leaves_all) {
  EXPECT_EQ(damping_ratio_of(std::exp(-2.0)), 1.0);
  EXPECT_EQ(damping_ratio_of(1.0), 0.0);
  EXPECT_EQ(restitution_of(0.0), 1.0);
  EXPECT_LT(abs(damping_ratio_of(FiftyDigits(exp(FiftyDigits(-2)))) - 1), 1e-49);
}

/// Beyond any double in the square of zeta, too.
TEST(Collision, the_least_share_has_a_finite_damping) {
  const double least = std::numeric_limits<double>::denorm_min();
  // zeta = R^(-1/2)/2 up to terms of relative size zeta^(-2) ln zeta; the exponential of ln R/2 = 372 loses three
  // digits
  EXPECT_NEAR(damping_ratio_of(least) / (0.5 / std::sqrt(least)), 1.0, 1e-13);
}

TEST(Collision, first_and_second_derivatives_are_those_of_differences_in_fifty_digits) {
  using First = Dual<double, 1>;
  using Second = Dual<First, 1>;
  for (const double R : shares()) {
    if (R < 1e-3) continue;
    const FiftyDigits step = FiftyDigits(R) * FiftyDigits("1e-14");  // its square is the error of the quotients
    const FiftyDigits at = damping_ratio_of(FiftyDigits(R)), ahead = damping_ratio_of(FiftyDigits(R + step)),
                      behind = damping_ratio_of(FiftyDigits(R - step));
    const double slope = static_cast<double>(FiftyDigits((ahead - behind) / (2 * step)));
    const double bend = static_cast<double>(FiftyDigits((ahead - 2 * at + behind) / (step * step)));
    const Second zeta = damping_ratio_of(Second(First(R, 0), 0));
    EXPECT_NEAR(zeta.value.slope[0] / slope, 1.0, 1e-13) << R;
    EXPECT_NEAR(zeta.slope[0].value / slope, 1.0, 1e-13) << R;
    EXPECT_NEAR(zeta.slope[0].slope[0] / bend, 1.0, 1e-12) << R;
  }
}

}  // namespace
}  // namespace clatter::collision_test
