// Dry friction by the exact method: closed forms, published numbers, and the run in 50 digits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "accuracy/run_record.hpp"
#include "point/point.hpp"
#include "support/friction_scenes.hpp"

namespace clatter::stepping::exact_friction_test {
namespace {

using accuracy::Event;
using accuracy::RunRecord;

constexpr double pi_ = std::numbers::pi;

std::vector<Event> those(const RunRecord& record, Event::Kind kind) {
  std::vector<Event> found;
  std::ranges::copy_if(accuracy::with_rests_joined(record.events), std::back_inserter(found),
                       [kind](const Event& event) { return event.kind == kind; });
  return found;
}

TEST(ExactFriction, free_motion_loses_four_times_the_friction_a_turn_and_stops) {
  const point::Problem scene = support::rubbing_from(5.3, {1, 1});
  for (const RunRecord& record : {accuracy::record_of(scene, 20), accuracy::reference_of(scene, 20)}) {
    const auto reversals = those(record, Event::Kind::reversal), sticks = those(record, Event::Kind::stick);
    ASSERT_EQ(reversals.size(), 2u);
    ASSERT_EQ(sticks.size(), 1u);
    EXPECT_NEAR(reversals[0].time, pi_, 1e-15 * 4);
    EXPECT_NEAR(reversals[0].place, -3.3, 1e-15 * 4);
    EXPECT_NEAR(reversals[1].time, 2 * pi_, 1e-15 * 8);
    EXPECT_NEAR(reversals[1].place, 1.3, 1e-15 * 8);
    EXPECT_NEAR(sticks[0].time, 3 * pi_, 1e-15 * 12);
    EXPECT_NEAR(sticks[0].place, 0.7, 1e-15 * 8);
    EXPECT_NEAR(sticks[0].end(), 20, 1e-15 * 20);
    EXPECT_EQ(record.v, 0);
  }
}

/// Den Hartog 1931: the amplitude of undamped forced motion that doesn't stick.
TEST(ExactFriction, forced_motion_settles_on_the_amplitude_of_den_hartog) {
  struct Case {
    double nu, mu, amplitude;
  };
  for (const auto& [nu, mu, amplitude] : {Case{0.8, 0.3, 2.62610487572348}, Case{1.3, 0.2, 1.39134462914783}}) {
    const double V = 1 / (1 - nu * nu), U = std::sin(pi_ / nu) / (nu * (1 + std::cos(pi_ / nu)));
    ASSERT_NEAR(std::sqrt(V * V - mu * U * mu * U), amplitude, 1e-14);
    point::Problem scene = support::rubbing_from(0, {mu, mu});
    scene.oscillator.forcing = 1, scene.oscillator.frequency = nu;
    const auto reversals = those(accuracy::record_of(scene, 400 * pi_ / nu), Event::Kind::reversal);
    ASSERT_GT(reversals.size(), 350u);
    for (std::size_t i = reversals.size() - 40; i < reversals.size(); ++i)
      EXPECT_NEAR(std::abs(reversals[i].place), amplitude, 1e-12);
    // a peak leads the force's zero by the angle whose cosine is mu U/V
    const double angle = std::remainder(nu * reversals.back().time, pi_);
    EXPECT_NEAR(std::abs(std::cos(angle)), std::abs(mu * U / V), 1e-12);
  }
}

/// From a displacement, settled: 200 forcing periods later.
RunRecord settled_from(double x) {
  point::Problem scene = support::rubbing_with_a_stick();
  scene.start.displacement = x;
  return accuracy::record_of(scene, 200 * 2 * pi_ / 1.3);
}

TEST(ExactFriction, motion_between_stops_sticks_once_a_period_and_has_a_mirror_image) {
  for (const auto& [x, sign] : {std::pair{0.0, 1}, {0.1, -1}}) {
    const RunRecord record = settled_from(x);
    const auto impacts = those(record, Event::Kind::impact), sticks = those(record, Event::Kind::stick);
    ASSERT_GE(impacts.size(), 400u);
    for (std::size_t i = impacts.size() - 6; i < impacts.size(); ++i) {
      const bool above = sign_of(impacts[i].side) == sign;
      EXPECT_NEAR(impacts[i].speed(), above ? 0.940532086164330 : 0.718708034646616, 1e-12);
    }
    for (std::size_t i = sticks.size() - 4; i + 1 < sticks.size(); ++i) {  // the last may be cut by the end
      EXPECT_NEAR(sticks[i].length, 0.315340026143191, 1e-12);
      EXPECT_NEAR(sticks[i].place, sign * -0.327636229491487, 1e-12);
    }
  }
}

TEST(ExactFriction, the_map_of_its_places_has_the_known_derivative) {
  point::Problem problem = support::rubbing_with_a_stick();
  problem.observe.impacts = problem.observe.of_sticks = problem.observe.stability = true;
  problem.time.tolerance = 1e-14;
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(problem, scratch);
  EXPECT_EQ(result.status, steady::Status::periodic);
  EXPECT_EQ(result.observed_turns, 1);
  EXPECT_NEAR(result.multiplier_re[0], 0.267959696315445, 1e-12);
  EXPECT_EQ(result.multiplier_re[1], 0);  // a stick erases the speed
  EXPECT_EQ(result.multiplier_im[0], 0);
  EXPECT_NEAR(result.stick_fraction, 0.315340026143191 / (2 * pi_ / 1.3), 1e-12);
}

/// Pressed onto a floor by a, and rubbing: each rebound has rho = R ((a - mu)/(a + mu))^(1/2) of the one before.
TEST(ExactFriction, a_mass_on_a_floor_comes_to_rest_after_a_geometric_series_even_if_impacts_are_elastic) {
  for (const double R : {0.5, 0.9, 1.0}) {
    point::Problem scene = support::scene_of({.load = -2, .stiffness = 0}, 0, 10, R);
    scene.start.velocity = 1, scene.friction = {0.5, 0.75};
    const double rho = R * std::sqrt(1.5 / 2.5), end = (1 / 2.5 + 1 / std::sqrt(1.5 * 2.5)) / (1 - rho);
    const RunRecord record = accuracy::record_of(scene, 20);
    const auto impacts = those(record, Event::Kind::impact), rests = those(record, Event::Kind::rest);
    ASSERT_GT(impacts.size(), 10u);
    for (std::size_t i = 0; i < impacts.size(); ++i)
      EXPECT_NEAR(impacts[i].speed() * R / std::pow(rho, static_cast<double>(i + 1)), 1,
                  1e-13);  // a rounding an impact
    ASSERT_EQ(rests.size(), 1u);
    EXPECT_NEAR(rests[0].time, end, 1e-14 * end);
    EXPECT_EQ(record.x, 0);
  }
}

TEST(ExactFriction, a_mass_without_speed_goes_at_the_phase_at_which_the_force_passes_the_static_level) {
  point::Problem scene = support::rubbing_from(0.1, {0.3, 0.6});
  scene.oscillator.forcing = 1, scene.oscillator.frequency = 0.7;
  for (const double kinetic : {0.3, 0.6}) {
    scene.friction.kinetic = kinetic;
    const auto sticks = those(accuracy::record_of(scene, 1.5), Event::Kind::stick);
    ASSERT_EQ(sticks.size(), 1u);
    EXPECT_NEAR(sticks[0].end(), std::asin(0.7) / 0.7, 1e-15 * 2);
  }
}

}  // namespace
}  // namespace clatter::stepping::exact_friction_test
