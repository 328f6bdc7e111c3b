// The method's accuracy, and that it finds every contact that its polynomials have.

#include "stepping/dormand_prince.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/deviation.hpp"
#include "support/methods.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::dormand_prince_test {
namespace {

constexpr double pi_ = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

accuracy::RunRecord run(point::Problem scene, double duration, double tolerance) {
  scene.integration.tolerance = tolerance;
  return support::record_by<DormandPrince>(scene, duration);
}

/// Evaluations and the largest error of some scenes over tolerances 10^-first ... 10^-last. One scene's error may be
/// small by chance at one of them.
struct Convergence {
  std::vector<double> tolerances{}, evaluations{}, errors{};

  Convergence(const std::vector<point::Problem>& scenes, double duration, int first, int last) {
    for (int digits = first; digits <= last; ++digits) {
      tolerances.push_back(std::pow(10.0, -digits)), evaluations.push_back(0), errors.push_back(0);
      for (const point::Problem& scene : scenes) {
        const accuracy::RunRecord record = run(scene, duration, tolerances.back());
        const support::Deviation d = support::deviation(record, accuracy::reference_of(scene, duration));
        EXPECT_TRUE(d.same_events) << "1e-" << digits << ": " << d.difference;
        evaluations.back() += record.evaluations, errors.back() = std::max(errors.back(), d.largest());
      }
    }
  }
};

/// Scenes with impacts, and some that never meet their stops.
std::vector<point::Problem> impacting() {
  std::vector<point::Problem> scenes;
  for (const double stop : {0.4, 0.45, 0.5, 0.55})
    scenes.push_back(support::scene_of({0.1, -1.0, 1.0, 0.0}, -stop, stop, 0.7));
  return scenes;
}
std::vector<point::Problem> smooth() {
  std::vector<point::Problem> scenes;
  for (const double nu : {1.1, 1.2, 1.3}) scenes.push_back(support::scene_of({0.1, -1.0, nu, 0.2}, -100, 100, 0.7));
  return scenes;
}

TEST(DormandPrince, is_of_fifth_order) {
  // a step's error goes with the sixth power of its length, the sum of all with the fifth power of the mean step. An
  // additional step at an impact, or one cut by a section, changes the count by a few percent at the coarse end, hence
  // the slope over five decades by a few tenths; one decade further rounding decides
  for (const auto& scenes : {impacting(), smooth()}) {
    const Convergence c(scenes, 20.0, 7, 12);
    EXPECT_NEAR(support::order_of(c.evaluations, c.errors), -5.0, 0.4);
    EXPECT_GT(c.evaluations.back(), 8 * c.evaluations.front());
  }
}

TEST(DormandPrince, errors_are_of_the_order_of_the_tolerance) {
  // the tolerance bounds the estimate of a step, that of order 4, from above and, to a factor of 2, from below; the
  // error of order 5 is smaller by about the step, and damping and restitution keep the errors of about as many steps
  // as there are in a unit of time
  for (const auto& scenes : {impacting(), smooth()}) {
    const Convergence c(scenes, 20.0, 3, 12);
    for (std::size_t i = 0; i < c.errors.size(); ++i) {
      EXPECT_LT(c.errors[i], 10 * c.tolerances[i]) << c.tolerances[i];
      EXPECT_GT(c.errors[i], c.tolerances[i] / 10) << c.tolerances[i];
    }
    EXPECT_NEAR(support::order_of(c.tolerances, c.errors), 1.0, 0.1);
  }
}

/// Counts arcs.
struct ArcCount {
  int arcs = 0;

  template <class A>
  void arc(const A&, double, double) {
    ++arcs;
  }
  void event(const motion::Event&) {}
};

TEST(DormandPrince, a_step_costs_seven_evaluations_and_a_refused_one_six) {
  // six for the pair, which reuses the evaluation at a step's end for the next one's beginning, and one for the arc's
  // end; each of the five periods, one of them cut short, begins with one of its own
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    point::Problem scene = smooth().back();
    scene.integration.tolerance = tolerance;
    ArcCount count;
    const accuracy::RunRecord record =
        support::run_by<DormandPrince>(scene, 4.5 * 2 * pi_ / scene.oscillator.frequency, count);
    const double refused = (record.evaluations - 7 * count.arcs - 5) / 6;
    EXPECT_GE(refused, 0) << tolerance;
    EXPECT_EQ(refused, std::floor(refused)) << tolerance;
    EXPECT_LT(refused, count.arcs / 2.0) << tolerance;
  }
}

/// Counts contacts in steps that begin, and would have ended, between the stops.
struct HiddenContacts {
  Stops stops;
  bool last_hides = false;
  int hidden = 0, impacts = 0;

  template <class A>
  void arc(const A& arc, double, double length) {
    const double first = arc.at(0.0).x, last = arc.at(arc.length()).x;
    last_hides = length < arc.length() && first < stops.upper && last < stops.upper;
  }
  void event(const motion::Event& event) {
    if (event.kind == motion::Event::Kind::impact) ++impacts, hidden += last_hides, last_hides = false;
  }
};

TEST(DormandPrince, finds_a_stop_that_is_crossed_twice_within_a_step) {
  // free vibration x = sin(tau + c) beyond a stop at 0.99 for 0.28 of tau, in steps of twice that, from fifty starts
  const double stop = 0.99, tolerance = 1e-4, speed = std::sqrt((1 - stop) * (1 + stop));
  int hidden = 0;
  for (int i = 0; i < 50; ++i) {
    const double before = 2.0 + 0.02 * i;  // of tau to the middle
    point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -infinity, stop, 0.5);
    scene.start = {std::sin(-before), std::cos(-before), 0.0};
    scene.integration.tolerance = tolerance;
    HiddenContacts seen{.stops = scene.stops};
    (void)support::run_by<DormandPrince>(scene, before + 2.0, seen);
    ASSERT_EQ(seen.impacts, 1) << i;
    hidden += seen.hidden;
    const accuracy::Event contact = support::record_by<DormandPrince>(scene, before + 2.0).events.at(0);
    EXPECT_NEAR(contact.time, before + std::asin(stop), 2 * tolerance / speed)
        << i;  // the error of the displacement over the speed
  }
  EXPECT_GT(hidden, 20);  // none of these shows in the gaps at the ends of the steps
}

TEST(DormandPrince, a_stop_that_is_missed_by_a_hair_is_not_met_and_one_a_hair_nearer_is) {
  const double hair = 1e-9;  // a hundred times the error of the displacement at this tolerance
  for (int i = 0; i < 50; ++i) {
    point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -infinity, 1 + hair, 0.5);
    scene.start = {std::sin(-2.0 - 0.02 * i), std::cos(-2.0 - 0.02 * i), 0.0};
    EXPECT_EQ(run(scene, 6.0, 1e-12).impacts, 0) << i;
    scene.stops.upper = 1 - hair;
    EXPECT_EQ(run(scene, 6.0, 1e-12).impacts, 1) << i;
  }
}

TEST(DormandPrince, a_stop_that_is_touched_without_speed_is_no_contact) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -infinity, 0.75, 0.5);
  scene.start.displacement = 0.75;  // at rest on it, and pulled away by the spring
  for (const double tolerance : {1e-2, 1e-12}) {
    const accuracy::RunRecord record = run(scene, 3.0, tolerance);
    EXPECT_TRUE(record.events.empty());
    EXPECT_NEAR(record.x, 0.75 * std::cos(3.0), 10 * tolerance);
  }
}

const point::Problem chattering = support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5);  // chatter and rest

TEST(DormandPrince, chatter_is_completed_and_the_mass_rests_until_its_release) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const accuracy::RunRecord record = run(chattering, 9.0, tolerance);
    const auto& events = record.events;
    EXPECT_NEAR(events.at(0).time, 2.0515931595927638, 10 * tolerance);
    EXPECT_NEAR(events.at(0).speed(), 0.57647176137699961, 10 * tolerance);
    EXPECT_NEAR(events.at(1).time, 3.1907700695690808, 10 * tolerance);
    const auto rest = std::ranges::find(events, accuracy::Event::Kind::rest, &accuracy::Event::kind);
    ASSERT_NE(rest, events.end());
    // a flight of time s, with speed s/4 and a displacement in error by the smaller of the tolerance and s^6, ends at a
    // time that is off by the ratio of the two: at most if the tolerance equals s^6
    EXPECT_NEAR(rest->time, 4.4158803670592697, 4 * std::pow(tolerance, 5.0 / 6)) << tolerance;
    EXPECT_NEAR(rest->end(), 5 * pi_ / 3, 4e-15);  // decided by the force alone
    EXPECT_EQ(events.back().side, Side::lower);
    EXPECT_NEAR(events.back().time, 7.9756605890323812, 10 * tolerance);
    EXPECT_NEAR(events.back().speed(), 0.7854147777624616, 10 * tolerance);
  }
}

TEST(DormandPrince, a_release_is_one_event_however_loose_the_tolerance) {
  // x'' = 0 there, to rounding: the error of a step must not decide where the mass goes
  for (const double R : {0.0, 0.5}) {
    point::Problem scene = chattering;
    scene.stops.restitution_lower = scene.stops.restitution_upper = R;
    scene.start = {0.5, 0.0, pi_ / 2};  // pressed
    const double duration = 4 * pi_ / 3 + 1;
    for (int digits = 1; digits <= 13; ++digits) {
      const accuracy::RunRecord record = run(scene, duration, std::pow(10.0, -digits));
      ASSERT_FALSE(record.events.empty());
      const accuracy::Event rest = record.events.front();
      ASSERT_EQ(rest.kind, accuracy::Event::Kind::rest);
      EXPECT_NEAR(rest.end(), (5 * pi_ / 6 - pi_ / 2) / 0.5, 4e-15);
      EXPECT_EQ(std::ranges::count(record.events, Side::upper, &accuracy::Event::side), 1)
          << "R = " << R << ", 1e-" << digits;
    }
    EXPECT_LT(run(scene, duration, 1e-2).evaluations, 500);
  }
}

TEST(DormandPrince, has_the_impacts_and_rests_of_the_exact_integrator) {
  for (const double R : {0.0, 0.3, 0.5}) {
    const point::Problem scene = support::scene_of({0.1, 2.0, 0.5, 0.0}, -0.5, 0.5, R);
    const accuracy::RunRecord reference = accuracy::record_of(scene, 40.0);
    ASSERT_GE(std::ranges::count(reference.events, accuracy::Event::Kind::rest, &accuracy::Event::kind), 6);
    for (int digits = 3; digits <= 13; ++digits) {
      const double tolerance = std::pow(10.0, -digits);
      const support::Deviation d = support::deviation(run(scene, 40.0, tolerance), reference);
      EXPECT_TRUE(d.same_events) << "R = " << R << ", " << tolerance << ": " << d.difference;
      EXPECT_LT(d.time, std::pow(tolerance, 5.0 / 6) / 10);  // as above, over the length of the run
      EXPECT_LT(d.speed, 10 * tolerance);                    // a rest forgets all errors before it
      EXPECT_LT(d.end, 10 * tolerance);
    }
  }
}

}  // namespace
}  // namespace clatter::stepping::dormand_prince_test
