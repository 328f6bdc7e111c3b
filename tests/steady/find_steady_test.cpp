#include "steady/find_steady.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "support/runs.hpp"

namespace clatter::steady::find_steady_test {
namespace {

constexpr double pi_ = std::numbers::pi;

point::Problem conservative(double lower, double upper, double x0, double v0) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, lower, upper, 1.0);
  scene.start = {x0, v0, 0.0};
  return scene;
}

constexpr double none = std::numeric_limits<double>::infinity();

TEST(Settle, free_vibration_between_stops_has_its_period_at_once) {
  // eq. 35: period 4 arcsin(g/V), speed at contact sqrt(V^2 - g^2); 2 pi if the stops are out of reach
  const double g = 0.749;
  for (double V : {0.3, 0.75, 1.0, 1.25, 1.5, 30.0}) {
    const support::Steady steady = support::steady_of(conservative(-g, g, 0.0, -V));
    EXPECT_EQ(steady.status, Status::periodic);
    const double speed = V > g ? std::sqrt((V - g) * (V + g)) : 1.0;
    // conditioning: an ulp of the stop's position moves the contact by itself over the speed
    EXPECT_NEAR(steady.length, V > g ? 4 * std::asin(g / V) : 2 * pi_, 1e-15 * (4 + 4 / speed)) << "V = " << V;
    EXPECT_EQ(steady.record.impacts.size(), V > g ? 2u : 0u);
    for (const motion::Event& impact : steady.record.impacts)
      EXPECT_NEAR(std::abs(impact.before) / speed, 1.0, 1e-15 * (4 + 4 * g / (speed * speed)));
    EXPECT_EQ(steady.from.v, -V);  // the start lies on the motion
  }
}

TEST(Settle, free_vibration_beside_one_stop) {
  for (double V : {0.2, 1.0, 7.0}) {
    EXPECT_NEAR(support::steady_of(conservative(0.0, none, 0.0, V)).length, pi_, 4e-15) << "stop in the centre";
    EXPECT_NEAR(support::steady_of(conservative(0.0, 0.1, 0.0, V)).length, 2 * std::asin(0.1 / V), 4e-15)
        << "stops at 0 and g";
    EXPECT_NEAR(support::steady_of(conservative(-none, 0.1, 0.0, V)).length, pi_ + 2 * std::asin(0.1 / V), 4e-15)
        << "stop beside the centre";
  }
}

TEST(Settle, symmetric_motion_has_the_speed_of_its_closed_form) {
  // eq. 37: (alpha^2 + gamma^2) u^2 - 2 alpha g u + g^2 - A^2 = 0
  const double h = 0.1, R = 0.7, nu = 1.0, f = 1.0;
  for (double g : {0.4, 0.5, 0.6}) {
    const double T = pi_ / nu, lambda = std::sqrt(1 - h * h), decay = std::exp(-h * T), c = std::cos(lambda * T),
                 s = std::sin(lambda * T) / lambda;
    const double phi11 = decay * (c + h * s), phi12 = decay * s, phi22 = decay * (c - h * s);
    const double D = std::pow(1 - nu * nu, 2) + std::pow(2 * h * nu, 2), D1 = 1 + phi11 + phi22 + decay * decay;
    const double alpha = (1 + R) * phi12 / D1, gamma = ((1 + R) * (1 + phi11) / D1 - R) / nu, A = f / std::sqrt(D);
    const double a = alpha * alpha + gamma * gamma, b = -2 * alpha * g, k = g * g - A * A;
    const double u = (-b + std::sqrt(b * b - 4 * a * k)) / (2 * a);
    if (g == 0.5) {
      EXPECT_NEAR(u, 0.88861376168497155, 1e-15);
    }
    point::Problem scene = support::scene_of({h, -f, nu, 0.0}, -g, g, R);
    scene.time.tolerance = 1e-14;
    const support::Steady steady = support::steady_of(scene);
    EXPECT_EQ(steady.status, Status::periodic);
    EXPECT_EQ(steady.turns, 1.0);
    ASSERT_EQ(steady.record.impacts.size(), 2u);
    for (const motion::Event& impact : steady.record.impacts)
      EXPECT_NEAR(std::abs(impact.before) / u, 1.0, 1e-12) << "g = " << g;
  }
}

TEST(Settle, impacts_per_period_are_those_the_paper_states) {
  const struct {
    double xs;
    long per_stop;
  } figures[] = {{0.3, 2}, {0.4, 1}, {0.5, 1}, {0.6, 1}};  // impacts of the paper's figures
  for (const auto& [xs, per_stop] : figures) {
    const support::Steady steady = support::steady_of(support::scene_of({0.1, -1.0, 1.0, 0.0}, -xs, xs, 0.7));
    EXPECT_EQ(steady.status, Status::periodic);
    EXPECT_EQ(steady.turns, 1.0);
    for (const Side side : {Side::lower, Side::upper})
      EXPECT_EQ(std::count_if(steady.record.impacts.begin(), steady.record.impacts.end(),
                              [&](const motion::Event& i) { return i.side == side; }),
                per_stop);
  }
}

TEST(Settle, slowly_alternating_transients_do_not_pass_for_a_longer_period) {
  const auto turns = [](double xs, double nu) {
    return support::steady_of(support::scene_of({0.1, -1.0, nu, 0.0}, -xs, xs, 0.7)).turns;
  };
  EXPECT_EQ(turns(4.0, 0.978), 1.0);  // Fig. 22
  EXPECT_EQ(turns(3.0, 0.868), 2.0);  // Fig. 23
}

TEST(Settle, motion_that_goes_round_in_its_rounding_is_periodic) {
  // after 24 forcing periods the states differ by 5e-14 for ever: at each section some divisor's distance has fallen
  for (int i = 0; i < 12; ++i) {
    point::Problem scene =
        support::scene_of({0.1, -1.0, 1.486986986986987, 0.0}, -0.21521521521521522, 0.21521521521521522, 0.7);
    scene.start.velocity = -1 + i * 2.0 / 59;
    const support::Steady steady = support::steady_of(scene);
    EXPECT_EQ(steady.status, Status::periodic) << i;
    EXPECT_EQ(steady.turns, 24.0) << i;
    EXPECT_LT(steady.settled, 4000.0) << i;
  }
}

TEST(Settle, inelastic_rest_repeats_after_exactly_one_forcing_period) {
  const support::Steady steady = support::steady_of(support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.0));
  EXPECT_EQ(steady.status, Status::periodic);
  EXPECT_EQ(steady.turns, 1.0);
  EXPECT_EQ(steady.length, 4 * pi_);
}

TEST(Settle, motion_that_does_not_repeat_is_aperiodic_over_the_window) {
  point::Problem scene = support::scene_of({0.1, -1.0, 0.9, 0.0}, -3, 3, 0.7);  // Fig. 23, just past grazing
  scene.time.max_periods = 500;
  scene.time.window = 10;
  const support::Steady steady = support::steady_of(scene);
  EXPECT_EQ(steady.status, Status::aperiodic);
  EXPECT_EQ(steady.turns, 10.0);
}

TEST(Settle, unforced_motion_comes_to_stand_still) {
  point::Problem decaying = support::scene_of({0.1, 0.0, 1.0, 0.0}, -1, 1, 0.7);
  decaying.start = {0.5, 0.0, 0.0};
  EXPECT_EQ(support::steady_of(decaying).found_by, FoundBy::standstill);
  point::Problem held = support::scene_of({0.1, 0.0, 1.0, 2.0}, -1, 1, 0.7);  // the load presses it onto the upper stop
  const support::Steady steady = support::steady_of(held);
  EXPECT_EQ(steady.found_by, FoundBy::standstill);
  EXPECT_EQ(steady.from.x, 1.0);
  ASSERT_EQ(steady.record.rests.size(), 1u);
  EXPECT_EQ(steady.record.rests[0].length, steady.length);
  EXPECT_EQ(support::steady_of(conservative(-1, 1, 0.0, 0.0)).found_by, FoundBy::standstill);  // at rest from the start
}

TEST(Settle, unforced_motion_that_loses_speed_at_stops_ends_as_free_vibration) {
  point::Problem scene = conservative(-0.5, 0.5, 0.0, 2.0);
  scene.stops.restitution_lower = scene.stops.restitution_upper = 0.5;
  const support::Steady steady = support::steady_of(scene);
  EXPECT_EQ(steady.status, Status::periodic);
  EXPECT_NEAR(steady.length, 2 * pi_,
              1e-5);  // contacts grow soft: pi - 2 arccos... differs by the last speed, below the tolerance's root
}

TEST(Settle, chatter_is_no_period) {
  for (double R : {0.5, 0.999, 0.9999}) {  // pressed by its load: the bounces die out, however slowly they change
    point::Problem scene = support::scene_of({0.1, 0.0, 1.0, 1.0}, -0.5, 0.5, R);
    scene.start = {0.5, -1.0, 0.0};
    const support::Steady steady = support::steady_of(scene);
    EXPECT_EQ(steady.status, Status::periodic);
    EXPECT_EQ(steady.found_by, FoundBy::standstill) << R;
  }
}

TEST(Settle, speed_lost_at_one_stop_in_the_centre_ends_in_standstill) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, 0.0, none, 0.5);
  scene.start = {1.0, 0.0, 0.0};
  EXPECT_EQ(support::steady_of(scene).found_by, FoundBy::standstill);
}

TEST(Settle, lanes_look_at_many_sections_in_a_row_before_each_attempt_and_at_the_end) {
  using Integrator = stepping::Exact<double, effect_sets::complete(Damping::light, Forcing::regular)>;
  const point::Problem scene = support::scene_of({0.1, -1.0, 1.0, 0.0}, -0.5, 0.5, 0.7);
  Integrator integrator(scene);
  for (const std::int64_t last : {1, 100, 300, 448, 449, 520, 5000, 12345}) {
    TimeSettings time;
    time.max_periods = last;
    const ForcedSearch<Integrator::effects> search(integrator, scene, time, AdvancedBy::lanes);
    std::vector<bool> seen(static_cast<std::size_t>(last) + 1, false);
    std::int64_t section = 0;
    for (; section < last; section += search.periods_from(section)) seen[static_cast<std::size_t>(section)] = true;
    EXPECT_EQ(section, last);
    for (std::int64_t attempt = 64; attempt < 2 * last; attempt *= 2)
      for (std::int64_t i = 0; i <= 192 && i <= attempt; ++i)
        EXPECT_TRUE(seen[static_cast<std::size_t>(std::max<std::int64_t>(0, std::min(attempt, last - 1) - i))])
            << last << ' ' << attempt << ' ' << i;
    if (last >= 5000) {
      EXPECT_LT(std::ranges::count(seen, true), last / 2);
    }
  }
}

TEST(Repeat, forgets_nothing_it_needs) {
  // a motion of 64 periods is found however long the settling before it was
  RepeatFinder finder(1e-12);
  std::size_t found = 0;
  int sections = 0;
  const auto settling = [](int k) { return std::exp(-0.05 * k); };
  for (; found == 0 && sections < 5000; ++sections)
    found =
        finder.add(std::cos(2 * pi_ * sections / 64.0) + settling(sections), std::sin(2 * pi_ * sections / 64.0), -0.1);
  EXPECT_EQ(found, 64u);
  EXPECT_LT(sections, 800);
}

/// The repeat that is found for a transient that shrinks by `rate` and rotates by `turn` a section, on its way to the
/// state (1, 0.5).
struct Repeat {
  std::size_t n = 0;
  double left = 0;  ///< size of the transient then
};

Repeat repeat_of(double rate, double turn, double size, int sections = 2000000) {
  RepeatFinder finder(1e-12);
  for (int k = 0; k < sections; ++k) {
    const double left = size * std::pow(rate, k), angle = turn * k;
    const std::size_t n = finder.add(1 + left * std::cos(angle), 0.5 + left * std::sin(angle), 2 * std::log(rate));
    if (n > 0) return {n, left};
  }
  return {};
}

TEST(Repeat, counts_the_rest_of_a_transient_not_the_part_that_a_period_removes) {
  // a pair of multipliers that rotates by nearly a third of a turn, as free motion under a force with nu near 3: after
  // three periods the distance of the states is a share 1 - rate^3 of the transient
  for (const double rate : {0.5, 0.99, 1 - 1e-3, 1 - 2e-4})
    for (const double off : {0.0, 1e-5, 1e-3, 0.1}) {
      const Repeat repeat = repeat_of(rate, 2 * pi_ / 3 + off, 1.0);
      EXPECT_EQ(repeat.n, 1u) << rate << ", " << off;
      EXPECT_LE(repeat.left, 4e-12) << rate << ", " << off;  // an ulp of 1 over 1 - rate
    }
}

TEST(Repeat, ends_where_rounding_stops_a_transient_and_is_labelled_by_its_limit) {
  // three periods reduce a transient of 8e-12, more than the tolerance, by an ulp of the state
  const Repeat repeat = repeat_of(1 - 1e-5, 2 * pi_ / 3, 1e-9);
  EXPECT_EQ(repeat.n, 1u);
  EXPECT_LE(repeat.left, 1e-11);
}

TEST(Repeat, the_observed_period_begins_with_the_lowest_state_under_a_negative_force_else_with_the_highest) {
  RepeatFinder finder(1e-12);
  const double x[] = {3.0, -1.0, 2.0, 3.0};
  for (const double each : x) (void)finder.add(each, each == 3.0 ? 0.25 : 0.5, -0.1);
  EXPECT_EQ(finder.first_of_last(3, BeginsBefore(-1.0)), 2u);
  EXPECT_EQ(finder.first_of_last(3, BeginsBefore(1.0)), 0u);
}

TEST(Repeat, a_motion_of_three_periods_is_found) {
  RepeatFinder finder(1e-12);
  std::size_t found = 0;
  const double x[] = {3.0, -1.0, 2.0};
  for (int k = 0; found == 0 && k < 100; ++k) found = finder.add(x[k % 3], 0.5, -0.1);
  EXPECT_EQ(found, 3u);
}

}  // namespace
}  // namespace clatter::steady::find_steady_test
