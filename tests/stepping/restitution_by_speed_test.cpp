// Restitution that depends on the speed of the impact: a ball on a floor, and a loose mass on a housing that stands,
// whose speeds and times are sums.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "math/fifty_digits.hpp"
#include "support/loose_scenes.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::restitution_by_speed_test {
namespace {

using support::LooseRun, support::Run, support::run_loose, support::run_scene;
using Law = Restitution<double>;
using Real = long double;
/// The share of a speed that an impact leaves.
using Share = std::function<Real(Real)>;

constexpr double infinity = std::numeric_limits<double>::infinity();

Law by_knots(const std::vector<SpeedTable::Knot>& knots) {
  Law law;
  law.table = kept(SpeedTable{knots});
  return law;
}
Law by_power(double R, double exponent, double reference) {
  Law law(R);
  law.exponent = exponent, law.reference = reference;
  return law;
}
Law but_below(Law law, double speed) {
  law.below = speed;
  return law;
}

struct Known {
  Law law;
  Share share;
};
/// Laws with what is known of them.
std::vector<Known> every_law() {
  const auto knots = [](Real v) {
    return v < 0.1L ? 0.9L : v < 0.5L ? 0.9L - (v - 0.1L) / 2 : std::min(0.7L + (v - 0.5L) / 5, 0.8L);
  };
  const auto viscoelastic = [](Real v) { return 1 - 0.4L * std::pow(v, 0.2L); };
  Law in_units = by_knots({{0.2, 0.9}, {1, 0.7}, {2, 0.8}});
  in_units.unit = 0.5;
  return {
      {by_knots({{0.1, 0.9}, {0.5, 0.7}, {1, 0.8}}), knots},
      {in_units, knots},
      {by_knots({{0.3, 0.6}}), [](Real) { return 0.6L; }},
      {by_power(0.6, 0.2, 1), viscoelastic},
      {by_power(1 - 0.4 * std::pow(0.03, 0.2), 0.2, 0.03), viscoelastic},
      {by_power(0.25, 0.5, 0.25), [](Real v) { return std::max(1 - 1.5L * std::sqrt(v), 1 / 3.0L); }},
      {but_below(0.8, 0.01), [](Real v) { return v < 0.01L ? 0 : 0.8L; }},
      {but_below(by_knots({{0.1, 0.9}, {0.5, 0.7}, {1, 0.8}}), 0.3), [=](Real v) { return v < 0.3L ? 0 : knots(v); }},
      {but_below(by_power(0.6, 0.2, 1), 0.02), [=](Real v) { return v < 0.02L ? 0 : viscoelastic(v); }}};
}

/// Thrown up from a floor, against a weight.
constexpr double weight = 0.8, thrown = 1.5;
point::Problem ball_on(const Law& law) {
  point::Problem scene;
  scene.oscillator = {.load = -weight, .stiffness = 0};
  scene.stops.lower = 0, scene.stops.restitution_lower = law;
  scene.start.velocity = thrown;
  return scene;
}

/// Each speed is the share of the one before, and each flight 2 v/g, until a speed is 0 or below what is told.
void expect_bounces(const std::vector<motion::Event>& impacts, const Share& share, Real slowest) {
  Real v = thrown, time = 2 * v / weight;
  std::size_t i = 0;
  for (; i < impacts.size() && v > slowest; ++i) {
    EXPECT_NEAR(static_cast<double>(-impacts[i].before / v), 1, 1e-13) << i;
    EXPECT_NEAR(static_cast<double>(impacts[i].time / time), 1, 1e-13) << i;
    v *= share(v), time += 2 * v / weight;
    EXPECT_NEAR(impacts[i].after, static_cast<double>(v), 1e-13 * static_cast<double>(v)) << i;
  }
  EXPECT_LE(v, slowest) << i;
}

template <class Number>
class RestitutionBySpeed : public testing::Test {};
using Numbers = testing::Types<double, FiftyDigits>;
TYPED_TEST_SUITE(RestitutionBySpeed, Numbers);

TYPED_TEST(RestitutionBySpeed, of_a_ball_on_a_floor_is_the_product_of_its_shares) {
  for (const auto& [law, share] : every_law()) {
    const Run<TypeParam> run = run_scene<TypeParam>(ball_on(law), 20);
    ASSERT_EQ(run.outcome, Outcome::completed);
    EXPECT_GT(run.record.impacts.size(), 4u);
    expect_bounces(run.record.impacts, share, 2e-3L);
  }
}

TYPED_TEST(RestitutionBySpeed, of_slow_impacts_ends_the_bounces_at_the_first_of_them) {
  for (const Law& law : {but_below(0.8, 0.01), but_below(by_knots({{0, 1}, {2, 0.5}}), 0.01),
                         but_below(by_power(0.6, 0.2, 1), 0.01), but_below(1.0, 2)}) {
    const auto [impacts, rests, touches, separations] = run_scene<TypeParam>(ball_on(law), 100).record;
    const Run<TypeParam> run = run_scene<TypeParam>(ball_on(law), 100);
    ASSERT_FALSE(impacts.empty());
    for (const auto& impact : impacts) EXPECT_EQ(std::abs(impact.before) < law.below, &impact == &impacts.back());
    EXPECT_EQ(impacts.back().after, 0);
    EXPECT_FALSE(std::signbit(impacts.back().after));
    ASSERT_FALSE(rests.empty());
    EXPECT_EQ(rests.front().kind, motion::Event::Kind::rest);
    EXPECT_EQ(rests.front().time, impacts.back().time);
    EXPECT_NEAR(rests.back().end(), 100, 1e-12);
    EXPECT_EQ(run.end.x, 0);
    EXPECT_EQ(run.end.v, 0);
  }
}

/// An impact at the very speed rebounds, one an ulp slower doesn't.
TYPED_TEST(RestitutionBySpeed, of_impacts_at_the_limit_is_that_of_faster_ones) {
  for (const Law& law : {but_below(0.5, 0.3), but_below(by_knots({{0.1, 0.5}}), 0.3)})
    for (const double speed : {0.3, std::nextafter(0.3, 0.0)}) {
      point::Problem scene = ball_on(law);
      scene.start.velocity = -speed;
      const auto impacts = run_scene<TypeParam>(scene, 0.1).record.impacts;
      ASSERT_EQ(impacts.size(), 1u);
      EXPECT_EQ(impacts[0].time, 0);
      EXPECT_EQ(impacts[0].after, speed < 0.3 ? 0 : 0.15);
    }
}

/// The times of all flights, from a speed on to one, and that speed; of no number that the program computes with.
struct Brute {
  Real time, last;
};
Brute brute_sum(const Share& share, Real last) {
  Brute sum{2 * Real(thrown) / weight, thrown};
  Real lost = 0;  // of the sum by rounding
  while ((sum.last *= share(sum.last)) > last) {
    const Real flight = 2 * sum.last / weight - lost, next = sum.time + flight;
    lost = (next - sum.time) - flight, sum.time = next;
  }
  return sum;
}

/// On straight lines between knots.
Real on_lines(const std::vector<SpeedTable::Knot>& knots, Real v) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (v >= knots[i].speed) continue;
    if (i == 0) break;
    const Real from = knots[i - 1].speed, to = knots[i].speed;
    return (knots[i - 1].R * (to - v) + knots[i].R * (v - from)) / (to - from);
  }
  return v < knots[0].speed ? knots[0].R : knots.back().R;
}

/// The first rest's beginning.
template <class Number>
double end_of_chatter(const Law& law) {
  const auto rests = run_scene<Number>(ball_on(law), 1000).record.rests;
  for (const auto& rest : rests)
    if (rest.kind == motion::Event::Kind::rest) return rest.time;
  return std::numeric_limits<double>::quiet_NaN();
}

TYPED_TEST(RestitutionBySpeed, of_knots_ends_a_chatter_where_all_its_flights_do) {
  for (const std::vector<SpeedTable::Knot>& knots :
       std::vector<std::vector<SpeedTable::Knot>>{{{0, 0.9}, {0.5, 0.6}},
                                                  {{0, 0.5}, {2, 1}},
                                                  {{0, 0.95}, {1e-6, 0.9}, {1e-3, 0.7}},
                                                  {{1e-4, 0.8}, {1, 0.9}}}) {
    const Brute sum = brute_sum([&](Real v) { return on_lines(knots, v); }, 1e-25L);
    EXPECT_NEAR(end_of_chatter<TypeParam>(by_knots(knots)) / static_cast<double>(sum.time), 1, 1e-14) << knots.size();
  }
}

/// What is left after a speed w is 2 w^(1 - p)/(a C (1 - p)) to first order.
TYPED_TEST(RestitutionBySpeed, of_a_power_ends_a_chatter_where_all_its_flights_do) {
  struct OfPower {
    double R, p;
    Real last;
  };
  for (const auto& [R, p, last] : {OfPower{0.6, 0.2, 1e-20L}, {0.7, 0.1, 1e-25L}, {0.5, 0.3, 1e-17L}}) {
    const Real power = p, C = 1 - Real(R);
    const Brute sum =
        brute_sum([&](Real v) { return std::max(1 - C * std::pow(v, power), power / (1 + power)); }, last);
    const Real tail = 2 * std::pow(sum.last, 1 - power) / (weight * C * (1 - power));
    ASSERT_LT(tail, 1e-10L);
    EXPECT_NEAR(end_of_chatter<TypeParam>(by_power(R, p, 1)) / static_cast<double>(sum.time + tail), 1, 1e-14) << p;
  }
}

/// Impacts on walls are followed until their flights are too short to advance time, of which a power takes v^-p/(p C).
TEST(RestitutionOfWalls, of_a_housing_that_stands_is_the_product_of_its_shares) {
  for (const auto& [law, share] : every_law()) {
    if (law.exponent > 0.3) continue;  // a hundred million of them
    point::Problem scene = support::loose_scene(1e-16, 0, 0, 1, 10, 1);
    scene.loose.load = -weight, scene.loose.restitution_lower = law;
    scene.loose.place = scene.loose.lower, scene.loose.velocity = thrown;
    const LooseRun run = run_loose(scene, 200);
    ASSERT_EQ(run.outcome, Outcome::completed);
    expect_bounces(run.record.strikes, share, 2e-3L);
    ASSERT_EQ(run.record.presses.size(), 1u);
    EXPECT_EQ(run.z, -10);
    EXPECT_EQ(run.w, 0);
    if (law.below > 0) {
      EXPECT_EQ(run.record.presses[0].time, run.record.strikes.back().time);
    }
  }
}

}  // namespace
}  // namespace clatter::stepping::restitution_by_speed_test
