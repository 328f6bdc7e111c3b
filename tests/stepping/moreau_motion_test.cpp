// Impacts, chatter, rest and release by time stepping, and the outcomes of runs that it can't complete.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "steady/find_steady.hpp"
#include "stepping/moreau.hpp"
#include "support/methods.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::moreau_motion_test {
namespace {

constexpr double pi_ = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

point::Problem with_step(point::Problem scene, double step, double theta = 0.5) {
  scene.integration.method = Method::moreau;
  scene.integration.step = step, scene.integration.theta = theta;
  return scene;
}

support::Recorder record_of(const point::Problem& scene, double duration) {
  support::Recorder record;
  EXPECT_EQ((run_by<Moreau>(scene, duration, record).outcome), Outcome::completed);
  return record;
}

TEST(MoreauMotion, an_impact_keeps_the_share_of_speed_that_restitution_says) {
  for (const double R : {0.0, 0.3, 1.0}) {
    point::Problem scene =
        with_step(support::scene_of({0.1, 0.45, 1.0, 0.0}, -0.5, 0.5, R), 1e-3);  // too weak to press it into a stop
    scene.stops.restitution_lower = R / 2;
    const support::Recorder record = record_of(scene, 20.0);
    ASSERT_GE(record.impacts.size(), 5u);
    for (const motion::Event& impact : record.impacts) {
      EXPECT_GT(impact.before * sign_of(impact.side), 0.0);
      EXPECT_EQ(impact.after, -(impact.side == Side::upper ? R : R / 2) * impact.before);
      EXPECT_EQ(impact.place, impact.side == Side::upper ? 0.5 : -0.5);
    }
  }
}

/// Records the position from which the mass leaves after an impact.
struct Departures {
  std::optional<motion::Event> last{};
  int count = 0;

  template <class A>
  void arc(const A& arc, double, double) {
    if (!last) return;
    EXPECT_EQ(arc.at(0.0).x, last->place);
    EXPECT_EQ(arc.at(0.0).v, 0.0);
    last.reset(), ++count;
  }
  void event(const motion::Event& event) {
    if (event.kind != motion::Event::Kind::impact) return;
    EXPECT_EQ(event.after, 0.0);
    EXPECT_FALSE(std::signbit(event.after));
    last = event;
  }
};

TEST(MoreauMotion, an_inelastic_mass_sets_out_from_the_stop_without_speed) {
  Departures departures;
  const point::Problem scene = with_step(support::scene_of({0.1, 0.45, 1.0, 0.0}, -0.5, 0.5, 0.0), 1e-3);
  ASSERT_EQ((support::run_by<Moreau>(scene, 20.0, departures).outcome), Outcome::completed);
  EXPECT_GE(departures.count, 5);
}

const point::Problem chattering = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);  // chatter and rest

TEST(MoreauMotion, chatter_ends_in_a_rest_within_a_step_for_each_of_its_impacts) {
  // an impact is late by up to a step, and its speed off by half a step's force, which costs the flights after it one
  // more step; the flights left out, each shorter than a step, last two steps together
  for (const double theta : {0.5, 1.0})
    for (int n = 256; n <= 16384; n *= 4) {
      double sum = 0, impacts = 0;
      for (int k = 0; k < 40; ++k) {
        const int steps = n + k * n / 64;
        const double step = 1.0 / steps, L = step * 4 * pi_;
        const std::vector<accuracy::Event> events =
            accuracy::with_rests_joined(support::record_by<Moreau>(with_step(chattering, step, theta), 5.0).events);
        const auto rest = std::ranges::find(events, accuracy::Event::Kind::rest, &accuracy::Event::kind);
        ASSERT_NE(rest, events.end());
        const auto before = static_cast<double>(rest - events.begin());
        EXPECT_NEAR(rest->time, 4.4158803670592697, (2 * before + 2) * L) << n << ", " << k;
        EXPECT_LE(before, 3 + std::log2(n));  // flights halve until one is shorter than a step
        sum += std::abs(rest->time - 4.4158803670592697) / L, impacts += before;
      }
      EXPECT_LT(sum, impacts) << n;  // in the mean half of the largest possible value
    }
}

TEST(MoreauMotion, after_a_rest_the_next_contact_is_within_a_step_again) {
  for (const double theta : {0.5, 1.0})
    for (int i = 8; i <= 14; ++i) {
      const double step = std::ldexp(1.0, -i), L = step * 4 * pi_;
      const auto events =
          accuracy::with_rests_joined(support::record_by<Moreau>(with_step(chattering, step, theta), 9.0).events);
      EXPECT_EQ(std::ranges::count(events, accuracy::Event::Kind::rest, &accuracy::Event::kind), 1);
      EXPECT_EQ(events.back().side, Side::lower);
      // a step at the release and one at the contact, with the speed of half a step away
      EXPECT_NEAR(events.back().time, 7.9756605890323812, 2 * L);
      EXPECT_NEAR(events.back().speed(), 0.7854147777624616, L);
    }
}

TEST(MoreauMotion, a_rest_ends_with_the_step_before_the_force_pulls) {
  // the force is evaluated once a step, theta of it after its beginning
  for (const double theta : {0.25, 0.5, 1.0}) {
    double earliest = infinity, latest = -infinity;  // in steps after the release
    for (int n = 1000; n < 1100; ++n) {
      const accuracy::RunRecord record = support::record_by<Moreau>(with_step(chattering, 1.0 / n, theta), 6.0);
      const accuracy::Event rest = accuracy::with_rests_joined(record.events).back();
      ASSERT_EQ(rest.kind, accuracy::Event::Kind::rest);
      const double late = (rest.end() - 5 * pi_ / 3) / (4 * pi_ / n);
      earliest = std::min(earliest, late), latest = std::max(latest, late);
    }
    EXPECT_NEAR(earliest, -theta, 0.1) << theta;  // releases lie at twelfths of a step
    EXPECT_NEAR(latest, 1 - theta, 0.1) << theta;
  }
}

TEST(MoreauMotion, a_mass_that_is_pressed_from_the_start_rests_without_impact) {
  for (const double R : {0.0, 0.7, 1.0}) {
    point::Problem scene = with_step(chattering, 1e-3);
    scene.stops.restitution_upper = R;
    scene.start = {0.5, 0.0, pi_ / 2};
    const accuracy::RunRecord record = support::record_by<Moreau>(scene, 3.0);
    const std::vector<accuracy::Event> events = accuracy::with_rests_joined(record.events);
    ASSERT_EQ(events.size(), 1u) << R;
    EXPECT_EQ(events[0].time, 0.0);
    EXPECT_NEAR(events[0].length, (5 * pi_ / 6 - pi_ / 2) / 0.5, 4 * pi_ * 1e-3);  // a step
    EXPECT_LT(record.x, 0.5);
  }
}

TEST(MoreauMotion, an_elastic_stop_returns_all_speed_and_keeps_an_oscillation_for_ever) {
  point::Problem scene = with_step(support::scene_of({0.0, 0.0, 1.0, 0.0}, -0.75, 0.75, 1.0), 1e-3);
  scene.start.velocity = 1.5;
  support::Recorder record = record_of(scene, 1e4);
  ASSERT_GT(record.impacts.size(), 9500u);  // every 2 asin(1/2) = pi/3
  // positions at impacts are known to a step, hence the speed by energy, without drift
  for (const motion::Event& impact : record.impacts)
    EXPECT_NEAR(std::abs(impact.before), std::sqrt(1.5 * 1.5 - 0.75 * 0.75), 0.75 * 2 * pi_ * 1e-3);
}

TEST(MoreauMotion, work_is_a_step_however_many_impacts_it_meets) {
  for (const double R : {0.0, 0.5, 0.9}) {
    point::Problem scene = with_step(chattering, 1e-3);
    scene.stops.restitution_lower = scene.stops.restitution_upper = R;
    const accuracy::RunRecord record = support::record_by<Moreau>(scene, 10 * 4 * pi_);
    EXPECT_GT(record.impacts, 15);
    EXPECT_EQ(record.evaluations, 10 * 1000);
  }
}

steady::ObservedTime settled(const point::Problem& scene) {
  return support::general_method<Moreau>(scene)->find_steady(support::start_of(scene));
}

TEST(MoreauMotion, is_found_to_repeat_or_not) {
  point::Problem scene = with_step(support::scene_of({0.1, -1.0, 1.0, 0.0}, -0.5, 0.5, 0.7), 1.0 / 4096);
  const steady::ObservedTime found = settled(scene);
  EXPECT_EQ(found.status, steady::Status::periodic);
  EXPECT_EQ(found.turns, 1.0);  // a coarser step may lock into several periods that differ by less than a step
  scene.time.max_periods = 3, scene.time.window = 7;
  const steady::ObservedTime too_early = settled(scene);
  EXPECT_EQ(too_early.status, steady::Status::aperiodic);
  EXPECT_EQ(too_early.turns, 7.0);
  point::Problem held = with_step(support::scene_of({0.1, 0.0, 1.0, 2.0}, -1.0, 1.0, 0.7), 1e-3);
  EXPECT_EQ(settled(held).found_by, steady::FoundBy::standstill);
}

TEST(MoreauMotion, between_sections_depends_on_the_state_alone) {
  point::Problem strong =
      support::scene_of({0.01, 50.0, 0.7, 0.0}, -70.0, 90.0, 0.8);  // so strong that a rounding of its phase shows
  strong.start.phase = 1.0;
  for (const point::Problem& scene : {chattering, strong})
    for (const double step : {0.013, 1e-3}) {
      const point::Problem stepped = with_step(scene, step);
      const auto first = support::general_method<Moreau>(stepped);
      motion::State<double> state;
      for (int period = 0; period < 20; ++period) {
        motion::State<double> copy = state;
        ASSERT_EQ(first->advance_to_section(state, 0), Outcome::completed);
        ASSERT_EQ(support::general_method<Moreau>(stepped)->advance_to_section(copy, 0), Outcome::completed);
        EXPECT_EQ(state.x, copy.x);
        EXPECT_EQ(state.v, copy.v);
      }
    }
}

TEST(MoreauMotion, mirrored_and_scaled_by_a_power_of_two_is_the_same_to_the_last_bit) {
  point::Problem scene = support::scene_of({0.1, 1.3, 0.6, 0.1}, -0.5, 0.4, 0.6);
  scene.stops.restitution_lower = 0.3;
  scene.start = {0.1, -0.7, 0.3};
  const accuracy::RunRecord a = support::record_by<Moreau>(with_step(scene, 1e-3), 50.0);
  ASSERT_GT(a.impacts, 10);
  for (const double factor : {-1.0, 0x1p-30, -0x1p40}) {
    point::Problem other = scene;
    other.oscillator.forcing *= factor, other.oscillator.load *= factor;
    other.start.displacement *= factor, other.start.velocity *= factor;
    other.stops.lower *= factor, other.stops.upper *= factor;
    if (factor < 0) {
      std::swap(other.stops.lower, other.stops.upper);
      std::swap(other.stops.restitution_lower, other.stops.restitution_upper);
    }
    const accuracy::RunRecord b = support::record_by<Moreau>(with_step(other, 1e-3), 50.0);
    EXPECT_EQ(a.x * factor, b.x);
    EXPECT_EQ(a.v * factor, b.v);
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t i = 0; i < a.events.size(); ++i) {
      EXPECT_EQ(a.events[i].time, b.events[i].time);
      EXPECT_EQ(a.events[i].speed() * std::abs(factor), b.events[i].speed());
    }
  }
}

TEST(MoreauMotion, more_impacts_than_allowed_and_no_numbers_are_outcomes) {
  point::Problem scene = with_step(support::scene_of({0.0, 0.0, 1.0, 0.0}, -0.75, 0.75, 1.0), 1e-3);
  scene.start.velocity = 1.5;
  scene.time.max_impacts = 10;
  const accuracy::RunRecord record = support::record_by<Moreau>(scene, 100.0);
  EXPECT_EQ(record.outcome, Outcome::event_budget);
  EXPECT_EQ(record.impacts, 11);
  for (const double value : {infinity, std::nan("")}) {
    scene.start.velocity = value;
    EXPECT_EQ(support::record_by<Moreau>(scene, 10.0).outcome, Outcome::not_finite) << value;
  }
}

}  // namespace
}  // namespace clatter::stepping::moreau_motion_test
