#include "motion/polynomial_arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/random.hpp"

namespace clatter::motion::polynomial_arc_test {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon(), pi_ = std::numbers::pi;
constexpr Effects effects = general_effects({.damping = 0.1}).arc();
using TestFlow = ArcConstants<double, effects>;

TEST(PolynomialArc, gives_its_polynomials_and_the_equations_acceleration) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    support::Random random(31, i);
    const Oscillator o{random.logarithmic(1e-3, 3), random.uniform(-2, 2), random.logarithmic(0.1, 10),
                       random.uniform(-1, 1)};
    const TestFlow constants(o);
    const double anchor = random.uniform(-2, 2), turns = random.uniform(0, 1), length = random.logarithmic(1e-6, 2);
    Bernstein<double> offset, velocity;
    for (std::size_t k = 0; k < offset.size(); ++k)
      offset[k] = random.uniform(-1, 1), velocity[k] = random.uniform(-1, 1);
    const PolynomialArc<effects> arc(constants, anchor, turns, length, offset, velocity);
    for (int k = 0; k <= 8; ++k) {
      const double s = length * k / 8, theta = 2 * pi_ * turns + o.frequency * s;
      const Motion<double> m = arc.at(s);
      EXPECT_EQ(m.offset, value_at(offset, s / length));
      EXPECT_EQ(m.v, value_at(velocity, s / length));
      EXPECT_EQ(m.x, anchor + m.offset);
      EXPECT_NEAR(m.sine, std::sin(theta), 4 * ulp * (1 + theta));  // an angle's roundings, made in another order
      EXPECT_NEAR(m.cosine, std::cos(theta), 4 * ulp * (1 + theta));
      const double force = o.forcing * m.sine + o.load, terms = 8 + 2 * o.damping;  // none of them is larger
      EXPECT_NEAR(m.a, force - m.x - 2 * o.damping * m.v, 4 * ulp * terms);
    }
  }
}

TEST(PolynomialArc, starts_where_its_polynomials_start) {
  const TestFlow constants({0.1, 1.0, 0.5, 0.2});
  const PolynomialArc<effects> arc(constants, 0.25, 0.75, 2.0, {1, 2, 3, 4, 5, 6, 7}, {-1, 0, 0, 0, 0, 0, 1});
  const Motion<double> m = arc.start();
  EXPECT_EQ(m.offset, 1.0);
  EXPECT_EQ(m.x, 1.25);
  EXPECT_EQ(m.v, -1.0);
  EXPECT_EQ(m.sine, -1.0);  // three quarters of a turn, exactly
  EXPECT_EQ(m.cosine, 0.0);
  EXPECT_EQ(arc.anchor(), 0.25);
  EXPECT_EQ(arc.length(), 2.0);
}

TEST(PolynomialArc, of_no_length_is_its_start) {
  const TestFlow constants({0.1, 1.0, 0.5, 0.0});
  const PolynomialArc<effects> arc(constants, 0.0, 0.25, 0.0, {3, 9, 9, 9, 9, 9, 9}, {4, 9, 9, 9, 9, 9, 9});
  EXPECT_EQ(arc.at(0.0).x, 3.0);
  EXPECT_EQ(arc.at(0.0).v, 4.0);
  EXPECT_EQ(arc.at(0.0).sine, 1.0);
}

TEST(PolynomialArc, a_whole_forcing_period_later_has_the_same_phase_to_the_last_bit) {
  const TestFlow constants({0.1, 1.0, 1.7, 0.0});
  const PolynomialArc<effects> arc(constants, 0.0, 0.125, 2 * constants.period, {}, {});
  EXPECT_EQ(arc.phase_after(constants.period).sine, arc.phase_after(0.0).sine);
  EXPECT_EQ(arc.phase_after(2 * constants.period).cosine, arc.phase_after(0.0).cosine);
}

TEST(PolynomialArc, acceleration_keeps_the_digits_of_a_flight_shorter_than_an_ulp_of_its_place) {
  // from a stop at the load's equilibrium x - load = offset, of which anchor + offset has no digit
  const TestFlow constants({0.0, 0.0, 1.0, 0.3});
  for (const double offset : {1e-9, 1e-17, 1e-300}) {
    Bernstein<double> flat;
    flat.fill(offset);
    EXPECT_EQ((PolynomialArc<effects>(constants, 0.3, 0.0, 1.0, flat, {}).at(0.5).a), -offset);
  }
}

}  // namespace
}  // namespace clatter::motion::polynomial_arc_test
