#include "scene/restitution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "math/dual.hpp"
#include "math/fifty_digits.hpp"
#include "support/random.hpp"

namespace clatter::restitution_test {
inline namespace scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Restitution<double> by_table(std::vector<SpeedTable::Knot> knots, double unit = 1.0) {
  Restitution<double> law;
  law.table = kept(SpeedTable{std::move(knots)});
  law.unit = unit;
  return law;
}
Restitution<double> by_power(double R, double p, double V) {
  Restitution<double> law(R);
  law.exponent = p, law.reference = V;
  return law;
}

/// Laws of each kind, with speeds up to about 3 on their pieces.
std::vector<Restitution<double>> some_laws() {
  std::vector<Restitution<double>> laws{Restitution<double>(0.6), by_table({{0.1, 0.9}, {0.5, 0.8}, {2, 0.6}}),
                                        by_table({{0, 0.9}, {1, 0.7}}, 0.7), by_power(0.7, 0.2, 1.5),
                                        by_power(0.3, 0.4, 0.8)};
  for (std::size_t i = 0; i < 5; ++i) {
    laws.push_back(laws[i]);
    laws.back().below = 0.05 * static_cast<double>(i + 1);
  }
  return laws;
}

TEST(RestitutionBySpeed, is_that_of_its_formulas) {
  const Restitution<double> table = by_table({{0.1, 0.9}, {0.5, 0.8}, {2, 0.6}}), power = by_power(0.7, 0.2, 1.5);
  EXPECT_DOUBLE_EQ(table.share(-0.05), 0.9);
  EXPECT_DOUBLE_EQ(table.share(0.3), 0.85);
  EXPECT_DOUBLE_EQ(table.share(-1.25), 0.7);
  EXPECT_DOUBLE_EQ(table.share(7.0), 0.6);
  EXPECT_DOUBLE_EQ(power.share(1.5), 0.7);
  EXPECT_DOUBLE_EQ(power.share(-1.5 * 32), 1 - 0.3 * 2);
  EXPECT_DOUBLE_EQ(power.share(1e9), 1.0 / 6);
  EXPECT_EQ(power.share(0.0), 1.0);
  Restitution<double> threshold(0.7);
  threshold.below = 0.2;
  EXPECT_EQ(threshold.after(0.19), 0.0);
  EXPECT_FALSE(std::signbit(threshold.after(0.19)));
  EXPECT_EQ(threshold.after(-0.2), 0.7 * 0.2);
}

TEST(RestitutionBySpeed, has_its_derivative_in_every_number) {
  for (const Restitution<double>& law : some_laws())
    for (const double v : {0.02, 0.3, 0.9, 1.7, 2.9, 40.0})
      for (const double sign : {-1.0, 1.0}) {
        const Dual<double, 1> by_itself(sign * v, 0);
        const Restitution<Dual<double, 1>> dual(law);
        EXPECT_NEAR(dual.after(by_itself).slope[0], law.derivative(sign * v), 1e-14);
        const FiftyDigits step(1e-20), at(sign * v);
        const Restitution<FiftyDigits> exact(law);
        const FiftyDigits slope = (exact.after(at + step) - exact.after(at - step)) / (2 * step);
        EXPECT_NEAR(static_cast<double>(slope), law.derivative(sign * v), 1e-14) << v;
      }
}

TEST(RestitutionBySpeed, never_lets_a_faster_impact_rebound_more_slowly) {
  for (const Restitution<double>& law : some_laws())
    for (double v = 1e-3, last = 0; v < 100; v *= 1.01) {
      const double after = -law.after(v);
      EXPECT_GE(after, last * (1 - 1e-14));
      EXPECT_LE(after, v);
      last = after;
    }
}

/// The speed after at any speed of an interval is within the bound of its tangent at any other.
TEST(RestitutionBySpeed, bounds_its_second_derivative_and_knows_its_corners) {
  support::Random random(14, 0);
  std::size_t bounded = 0, refused = 0;
  for (const Restitution<double>& law : some_laws())
    for (int i = 0; i < 400; ++i) {
      const double slowest = random.uniform(0.01, 3), fastest = slowest * random.uniform(1, 1.5);
      const auto bend = law.bend(slowest, fastest);
      if (!bend) {
        ++refused;
        continue;
      }
      ++bounded;
      const double v = random.uniform(slowest, fastest), other = random.uniform(slowest, fastest), d = other - v;
      const double off = std::abs(law.after(other) - law.after(v) - law.derivative(v) * d);
      EXPECT_LE(off, *bend * d * d / 2 + 1e-14) << v << ' ' << other;
    }
  EXPECT_GT(bounded, 2000u);
  EXPECT_GT(refused, 200u);
}

TEST(RestitutionBySpeed, knows_where_it_begins) {
  const Restitution<double> sloped = by_table({{0, 0.9}, {2, 0.5}}), flat = by_table({{0.5, 0.8}, {2, 0.6}});
  EXPECT_DOUBLE_EQ(sloped.share_at_rest(), 0.9);
  EXPECT_DOUBLE_EQ(sloped.at_rest().slope, -0.2);
  EXPECT_DOUBLE_EQ(sloped.at_rest().end, 2);
  EXPECT_DOUBLE_EQ(flat.at_rest().slope, 0);
  EXPECT_DOUBLE_EQ(flat.at_rest().end, 0.5);
  EXPECT_EQ(by_power(0.7, 0.2, 1.0).share_at_rest(), 1.0);
  EXPECT_TRUE(by_power(0.7, 0.2, 1.0).loses());
  EXPECT_FALSE(by_power(1.0, 0.2, 1.0).takes_energy());
  EXPECT_FALSE(by_table({{0.5, 1.0}, {2, 0.6}}).loses());
  EXPECT_TRUE(by_table({{0.5, 1.0}, {2, 0.6}}).takes_energy());
  EXPECT_EQ(Restitution<double>(0.3).at_rest().end, infinity);
}

TEST(RestitutionBySpeed, counts_speeds_in_other_units) {
  for (const Restitution<double>& law : some_laws()) {
    Restitution<double> other = law;
    other.scale_speeds(0.25);
    for (const double v : {0.02, 0.3, 0.9, 2.9}) EXPECT_NEAR(other.share(v / 4), law.share(v), 1e-15);
  }
}

}  // namespace
}  // namespace scene
}  // namespace clatter::restitution_test
