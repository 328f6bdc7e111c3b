// Time stepping: its order, and events located to a step.

#include "stepping/moreau.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steady/find_steady.hpp"
#include "support/deviation.hpp"
#include "support/methods.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::moreau_test {
namespace {

constexpr double pi_ = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();
constexpr double ulp = std::numeric_limits<double>::epsilon();

point::Problem with_step(point::Problem scene, double step, double theta = 0.5) {
  scene.integration.method = Method::moreau;
  scene.integration.step = step, scene.integration.theta = theta;
  return scene;
}

/// Error at the end of smooth motion over steps of 2^-first ... 2^-last forcing periods, as an order in the step.
double order_of_smooth_motion(const point::Problem& scene, double theta, int first, int last) {
  const accuracy::RunRecord reference = accuracy::reference_of(scene, 20.0);
  std::vector<double> steps, errors;
  for (int i = first; i <= last; ++i) {
    steps.push_back(std::ldexp(1.0, -i));
    errors.push_back(
        support::deviation(support::record_by<Moreau>(with_step(scene, steps.back(), theta), 20.0), reference).end);
  }
  return support::order_of(steps, errors);
}

TEST(Moreau, is_of_second_order_on_smooth_motion_and_of_first_away_from_theta_one_half) {
  // the next order's share of the error is of the size of the step: below 2^-6 of 2 pi a few percent
  for (const Oscillator& oscillator : {Oscillator{0.1, -1.0, 1.3, 0.2}, Oscillator{0.0, 1.0, 0.7, 0.0},
                                       Oscillator{1.7, 3.0, 0.7, 0.1}, Oscillator{0.0, 1.0, 1.0, 0.0}}) {
    const point::Problem scene = support::scene_of(oscillator, -infinity, infinity, 1.0);
    EXPECT_NEAR(order_of_smooth_motion(scene, 0.5, 6, 12), 2.0, 0.05);
    for (const double theta : {0.0, 0.75, 1.0})
      EXPECT_NEAR(order_of_smooth_motion(scene, theta, 8, 14), 1.0, 0.05) << theta;
  }
}

TEST(Moreau, the_trapezoidal_rule_keeps_the_energy_of_free_motion_and_its_neighbours_do_not) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -infinity, infinity, 1.0);
  scene.start = {0.6, -0.8, 0.0};
  const auto energy = [&](double theta) {
    const accuracy::RunRecord record = support::record_by<Moreau>(with_step(scene, 0.01, theta), 200 * pi_);
    return record.x * record.x + record.v * record.v;
  };
  EXPECT_NEAR(energy(0.5), 1.0, 1e4 * 4 * ulp);  // a few roundings in each of ten thousand steps
  // a step L multiplies it by (1 + (1 - theta)^2 L^2)/(1 + theta^2 L^2)
  const double L = 0.02 * pi_;
  EXPECT_NEAR(std::log(energy(0.0)) / (1e4 * std::log1p(L * L)), 1.0, 1e-10);
  EXPECT_NEAR(std::log(energy(1.0)) / (-1e4 * std::log1p(L * L)), 1.0, 1e-10);
}

/// Free vibration from the middle at unit speed, to an upper stop that is met at asin(position).
point::Problem first_contact(double position, double R) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -infinity, position, R);
  scene.start.velocity = 1.0;
  return scene;
}

TEST(Moreau, an_impact_is_shown_within_a_step) {
  // the impulse is in the first step in whose middle the mass would be beyond the stop, 1 - theta of it after its
  // beginning; the way is so short that the motion is uniform to a ten thousandth
  for (const double theta : {0.0, 0.5, 0.75, 1.0}) {
    double earliest = infinity, latest = -infinity;  // in steps after the contact
    for (int n = 6000; n < 8000; n += 7) {
      const accuracy::Event impact =
          support::record_by<Moreau>(with_step(first_contact(0.01, 0.7), 1.0 / n, theta), 0.02).events.at(0);
      const double late = (impact.time - std::asin(0.01)) / (2 * pi_ / n);
      earliest = std::min(earliest, late), latest = std::max(latest, late);
    }
    // over three hundred steps, whose ends lie anywhere; the error of the displacement itself is a thousandth of a step
    EXPECT_NEAR(earliest, 0.5 - theta, 0.005) << theta;
    EXPECT_NEAR(latest, 1.5 - theta, 0.005) << theta;
  }
}

TEST(Moreau, an_impacts_speed_is_the_one_half_a_step_off_at_most) {
  double worst = 0;
  for (int n = 1000; n < 1200; ++n) {
    const double allowed = 0.6 * pi_ / n;  // deceleration at the stop times half a step, 2 pi/n/2
    const accuracy::Event impact =
        support::record_by<Moreau>(with_step(first_contact(0.6, 0.7), 1.0 / n), 1.0).events.at(0);
    const double error = std::abs(impact.speed() - 0.8) / allowed;
    EXPECT_LE(error, 1.02) << n;  // the parts by the jerk and by the rule are of the order of a step
    worst = std::max(worst, error);
  }
  EXPECT_GT(worst, 0.95);
}

TEST(Moreau, impact_times_and_speeds_are_of_first_order) {
  // the mean over steps that end anywhere, since the error of a single one may have any value up to its bound
  const point::Problem scene = support::scene_of({0.1, -1.0, 1.0, 0.0}, -0.5, 0.5, 0.7);
  const accuracy::RunRecord reference = accuracy::reference_of(scene, 20.0);
  ASSERT_GE(reference.impacts, 6);
  for (const double theta : {0.5, 1.0}) {
    std::vector<double> steps, times, speeds, ends;
    for (int n = 1 << 8; n <= 1 << 13; n *= 2) {
      double time = 0, speed = 0, end = 0;
      for (int k = 0; k < 40; ++k) {
        const int steps_a_period = n + k * n / 64;
        const support::Deviation d = support::deviation(
            support::record_by<Moreau>(with_step(scene, 1.0 / steps_a_period, theta), 20.0), reference);
        ASSERT_TRUE(d.same_events) << n << ": " << d.difference;
        time += d.time, speed += d.speed, end += d.end;
      }
      steps.push_back(1.0 / n), times.push_back(time), speeds.push_back(speed), ends.push_back(end);
    }
    EXPECT_NEAR(support::order_of(steps, times), 1.0, 0.1) << theta;
    EXPECT_NEAR(support::order_of(steps, speeds), 1.0, 0.1) << theta;
    EXPECT_NEAR(support::order_of(steps, ends), 1.0, 0.1) << theta;
  }
}

/// Records the depth to which a run goes beyond its stops, its largest speed, and its arcs' times.
struct Beyond {
  Stops stops;
  double depth = 0, speed = 0, end = 0;
  bool gapless = true;

  template <class A>
  void arc(const A& arc, double begin, double length) {
    gapless = gapless && std::abs(begin - end) <= 1e-12, end = begin + length;
    for (const double s : {0.0, length}) {
      const motion::Motion<double> m = arc.at(s);
      depth = std::max({depth, m.x - stops.upper, stops.lower - m.x}), speed = std::max(speed, std::abs(m.v));
    }
  }
  void event(const motion::Event& event) {
    if (event.lasts()) gapless = gapless && std::abs(event.time - end) <= 1e-12, end = event.end();
    if (!event.lasts()) speed = std::max(speed, std::abs(event.before));
  }
};

TEST(Moreau, goes_beyond_a_stop_by_a_step_at_most_and_arcs_and_rests_leave_no_gap) {
  // half a step at the speed of the step before, whose middle was still between the stops, and 1 - theta of one more
  for (const double theta : {0.5, 1.0})
    for (const double R : {0.0, 0.5, 1.0}) {
      double worst = 0;
      for (int n = 100; n < 140; ++n) {
        const point::Problem scene = with_step(support::scene_of({0.1, 2.0, 0.8, 0.0}, -0.5, 0.4, R), 1.0 / n, theta);
        Beyond beyond{.stops = scene.stops};
        ASSERT_EQ((support::run_by<Moreau>(scene, 50.0, beyond).outcome), Outcome::completed);
        const double L = 2 * pi_ / 0.8 / n;
        EXPECT_LE(beyond.depth, (1.5 - theta) * L * beyond.speed * 1.05);  // while the speed changes by a twentieth
        worst = std::max(worst, beyond.depth / (L * beyond.speed));
        EXPECT_TRUE(beyond.gapless);
        EXPECT_NEAR(beyond.end, 50.0, 1e-12);
      }
      EXPECT_GT(worst, (1.5 - theta) / 2);
    }
}

/// Counts the arcs, rests and impacts of a run, and records its shortest and longest step.
struct Steps {
  int arcs = 0;
  double shortest = infinity, longest = 0;

  template <class A>
  void arc(const A&, double, double length) {
    ++arcs, shortest = std::min(shortest, length), longest = std::max(longest, length);
  }
  void event(const motion::Event&) {}
};

TEST(Moreau, steps_count_from_the_section_and_the_last_one_is_cut_there) {
  const struct {
    double step;
    int per_period;
    double last;
  } cases[] = {{0.3, 4, 0.1}, {1.0 / 3, 3, 1.0 / 3}, {0.1, 10, 0.1}, {1.0 / 49, 49, 1.0 / 49},
               {0.7, 2, 0.3}, {1.0, 1, 1.0}};
  for (const auto& [step, per_period, last] : cases) {
    const point::Problem scene = with_step(support::scene_of({0.1, 1.0, 0.8, 0.0}, -infinity, infinity, 1.0), step);
    const double period = 2 * pi_ / 0.8;
    Steps steps;
    const accuracy::RunRecord record = support::run_by<Moreau>(scene, 5 * period, steps);
    EXPECT_EQ(steps.arcs, 5 * per_period) << step;
    EXPECT_EQ(record.evaluations, 5 * per_period) << step;  // the equation is solved once a step
    EXPECT_NEAR(steps.longest, step * period, 1e-14);
    EXPECT_NEAR(steps.shortest, last * period, 1e-14);
  }
}

TEST(Moreau, an_end_within_a_period_cuts_a_step_too) {
  const point::Problem scene = with_step(support::scene_of({0.1, 1.0, 0.8, 0.0}, -infinity, infinity, 1.0), 0.1);
  Steps steps;
  const accuracy::RunRecord record = support::run_by<Moreau>(scene, 1.25 * 2 * pi_ / 0.8, steps);
  EXPECT_EQ(steps.arcs, 13);
  EXPECT_EQ(record.evaluations, 13);
  EXPECT_NEAR(steps.shortest, 0.05 * 2 * pi_ / 0.8, 1e-14);
}

}  // namespace
}  // namespace clatter::stepping::moreau_test
