// The method on every kind of scene: periods, rests, symmetries, and the outcomes of runs that it can't complete.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steady/find_steady.hpp"
#include "stepping/dormand_prince.hpp"
#include "support/deviation.hpp"
#include "support/methods.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::dormand_prince_motion_test {
namespace {

constexpr double pi_ = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

point::Problem with_tolerance(point::Problem scene, double tolerance) {
  scene.integration.method = Method::dopri5, scene.integration.tolerance = tolerance;
  return scene;
}

steady::ObservedTime settled(const point::Problem& scene) {
  return support::general_method<DormandPrince>(scene)->find_steady(support::start_of(scene));
}

void expect_same_events(const std::vector<accuracy::Event>& a, const std::vector<accuracy::Event>& b, double sign,
                        double scale) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_EQ(sign * sign_of(a[i].side), sign_of(b[i].side));
    EXPECT_EQ(a[i].time, b[i].time);
    EXPECT_EQ(a[i].length, b[i].length);
    EXPECT_EQ(a[i].speed() * scale, b[i].speed());
  }
}

struct Named {
  const char* name;
  point::Problem scene;
};

/// Scenes with impacts, chatter, rest, a pressing load, heavy damping, a pulling load, resonance, free motion.
std::vector<Named> every_kind() {
  std::vector<Named> scenes{
      {"impacts", support::scene_of({0.1, -1.0, 1.0, 0.0}, -0.5, 0.5, 0.7)},
      {"one stop, load", support::scene_of({0.05, 1.0, 0.8, -0.3}, -0.4, infinity, 0.8)},
      {"chatter and rest", support::scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5)},
      {"critical", support::scene_of({1.0, 2.0, 0.9, 0.2}, -0.4, 0.5, 0.6)},
      {"heavy", support::scene_of({1.7, 3.0, 0.7, 0.1}, -0.3, 0.4, 0.6)},
      {"resonance without stops", support::scene_of({0.0, 1.0, 1.0, 0.0}, -infinity, infinity, 1.0)},
      {"resonance with stops", support::scene_of({0.0, 1.0, 1.0, 0.0}, -2.0, 2.0, 0.5)},
      {"fast force", support::scene_of({0.1, 5.0, 7.0, 0.0}, -0.05, 0.1, 0.7)},
      {"free, between stops", support::scene_of({0.0, 0.0, 1.0, 0.1}, -0.75, 0.6, 0.9)}};
  scenes.back().scene.start.velocity = 1.5;
  scenes[1].scene.stops.restitution_lower = 0.6;
  return scenes;
}

TEST(DormandPrinceMotion, of_every_kind_is_that_of_fifty_digits) {
  for (const auto& [name, scene] : every_kind()) {
    const accuracy::RunRecord reference = accuracy::reference_of(scene, 15.0);
    const double sensitive = std::max(1.0, support::conditioning(scene, reference) / epsilon<double>());
    for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
      const support::Deviation d =
          support::deviation(support::record_by<DormandPrince>(with_tolerance(scene, tolerance), 15.0), reference);
      EXPECT_TRUE(d.same_events) << name << ": " << d.difference;
      // every step errs by about the tolerance, which the motion multiplies as much as an ulp of its inputs
      EXPECT_LT(d.largest(), 4 * tolerance * sensitive) << name << ", " << tolerance;
    }
  }
}

TEST(DormandPrinceMotion, at_resonance_grows_as_its_closed_form) {
  // h = 0, nu = 1, from rest: x = -(tau cos tau - sin tau)/2
  const double tau = 20 * pi_ + 1;
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    point::Problem scene = with_tolerance(support::scene_of({0.0, 1.0, 1.0, 0.0}, -infinity, infinity, 1.0), tolerance);
    const accuracy::RunRecord record = support::record_by<DormandPrince>(scene, tau);
    // relative to the amplitude tau/2; nothing fades, and the errors of ten periods add up, each relative to its own
    EXPECT_NEAR(record.x / (tau / 2), -(tau * std::cos(tau) - std::sin(tau)) / tau, 10 * tolerance);
    EXPECT_NEAR(record.v / (tau / 2), std::sin(tau), 10 * tolerance);
  }
}

TEST(DormandPrinceMotion, between_sections_depends_on_the_state_alone) {
  // a new integrator continues from a section as the one that reached it, to the last bit, though not within a period
  for (const auto& [kind, of_kind] : every_kind()) {
    const point::Problem scene = with_tolerance(of_kind, 1e-6);
    const auto first = support::general_method<DormandPrince>(scene);
    motion::State<double> state = support::start_of(scene);
    for (int period = 0; period < 6; ++period) {
      const auto other = support::general_method<DormandPrince>(scene);
      motion::State<double> copy = state;
      copy.periods = 0;
      support::EventList events, others;
      support::Seeing seeing(events), seeing_others(others);
      ASSERT_EQ(first->advance_to_section(state, state.periods, &seeing), Outcome::completed) << kind;
      ASSERT_EQ(other->advance_to_section(copy, 0, &seeing_others), Outcome::completed) << kind;
      EXPECT_EQ(state.x, copy.x) << kind;
      EXPECT_EQ(state.v, copy.v) << kind;
      expect_same_events(events.events, others.events, 1, 1);
    }
  }
}

TEST(DormandPrinceMotion, mirrored_and_scaled_by_a_power_of_two_is_the_same_to_the_last_bit) {
  for (const auto& [name, scene] : every_kind())
    for (const double factor : {-1.0, 0x1p-30, -0x1p40}) {
      const double sign = factor < 0 ? -1 : 1;
      point::Problem other = scene;
      other.oscillator.forcing *= factor, other.oscillator.load *= factor;
      other.start.displacement *= factor, other.start.velocity *= factor;
      other.stops.lower *= factor, other.stops.upper *= factor;
      if (sign < 0) {
        std::swap(other.stops.lower, other.stops.upper);
        std::swap(other.stops.restitution_lower, other.stops.restitution_upper);
      }
      const accuracy::RunRecord a = support::record_by<DormandPrince>(with_tolerance(scene, 1e-7), 15.0);
      const accuracy::RunRecord b = support::record_by<DormandPrince>(with_tolerance(other, 1e-7), 15.0);
      expect_same_events(a.events, b.events, sign, std::abs(factor));
      EXPECT_EQ(a.x * factor, b.x) << name << " by " << factor;
      EXPECT_EQ(a.v * factor, b.v) << name << " by " << factor;
      EXPECT_EQ(a.evaluations, b.evaluations) << name << " by " << factor;
    }
}

TEST(DormandPrinceMotion, has_the_period_of_the_exact_one_on_figure_22) {
  int periodic = 0;
  for (int i = 0; i <= 500; i += 20) {
    const double nu = 0.5 + i / 500.0;
    point::Problem scene = support::scene_of({0.1, -1.0, nu, 0.0}, -4.0, 4.0, 0.7);
    scene.time.max_periods = 1000;
    const support::Steady exact = support::steady_of(scene);
    const steady::ObservedTime found = settled(with_tolerance(scene, 1e-10));
    EXPECT_EQ(found.status, exact.status) << nu;  // from nu = 0.914 to 0.976 aperiodic
    if (exact.status != steady::Status::periodic) continue;
    ++periodic;
    EXPECT_EQ(found.found_by, steady::FoundBy::repetition);
    EXPECT_EQ(found.turns, exact.turns) << nu;
    // errors of the steps of the last 1/h = 10 of tau, and of the period that is observed
    EXPECT_NEAR(found.from.x, exact.from.x, 20e-10) << nu;
    EXPECT_NEAR(found.from.v, exact.from.v, 20e-10) << nu;
  }
  EXPECT_GE(periodic, 20);
}

TEST(DormandPrinceMotion, unforced_and_conservative_returns_after_its_closed_form) {
  // eq. 35: period 4 arcsin(g/V) between stops; 2 pi without one
  for (const double V : {0.5, 1.0, 1.5}) {
    const double g = 0.749, tolerance = 1e-11;
    point::Problem scene = with_tolerance(support::scene_of({0.0, 0.0, 1.0, 0.0}, -g, g, 1.0), tolerance);
    scene.start.velocity = -V;
    scene.time.tolerance = 1e-8;  // of the return: more than the motion drifts in a period
    const steady::ObservedTime found = settled(scene);
    EXPECT_EQ(found.status, steady::Status::periodic);
    const double speed = V > g ? std::sqrt((V - g) * (V + g)) : 1;
    EXPECT_NEAR(found.turns * 2 * pi_, V > g ? 4 * std::asin(g / V) : 2 * pi_, 10 * tolerance / speed) << V;
  }
}

TEST(DormandPrinceMotion, unforced_and_damped_comes_to_stand_still) {
  point::Problem held =
      support::scene_of({0.1, 0.0, 1.0, 2.0}, -1.0, 1.0, 0.7);  // the load presses it onto the upper stop
  const steady::ObservedTime on_stop = settled(with_tolerance(held, 1e-8));
  EXPECT_EQ(on_stop.found_by, steady::FoundBy::standstill);
  EXPECT_EQ(on_stop.from.x, 1.0);
  EXPECT_EQ(on_stop.from.v, 0.0);
  point::Problem fading = support::scene_of({0.1, 0.0, 1.0, 0.3}, -1.0, 1.0, 0.7);
  fading.start.displacement = -0.5;
  fading.time.tolerance = 1e-10;  // above the errors that steps go on making
  const steady::ObservedTime in_between = settled(with_tolerance(fading, 1e-12));
  EXPECT_EQ(in_between.found_by, steady::FoundBy::standstill);
  EXPECT_NEAR(in_between.from.x, 0.3, 1e-10);
}

TEST(DormandPrinceMotion, a_step_that_ends_an_ulp_beyond_a_stop_ends_on_it) {
  // beside the stop by the rounding of position and anchor; a pressed inelastic mass rests there, and time advances
  point::Problem scene = support::scene_of({0.1, 0.0, 1.0, 2.0}, -1.0, 1.0, 0.0);
  motion::State<double> state;
  state.x = std::nextafter(1.0, 2.0), state.v = 0.5;
  support::EventList list;
  support::Seeing seeing(list);
  ASSERT_EQ(support::general_method<DormandPrince>(scene)->advance(state, 1e-4, &seeing), Outcome::completed);
  ASSERT_EQ(list.events.size(), 2u);
  EXPECT_EQ(list.events[0].kind, accuracy::Event::Kind::impact);
  EXPECT_EQ(list.events[1].kind, accuracy::Event::Kind::rest);
  EXPECT_EQ(state.x, 1.0);
}

TEST(DormandPrinceMotion, more_impacts_than_allowed_is_an_outcome) {
  point::Problem scene = support::scene_of({0.0, 0.0, 1.0, 0.0}, -0.75, 0.75, 1.0);
  scene.start.velocity = 1.5;
  scene.time.max_impacts = 10;
  const accuracy::RunRecord record = support::record_by<DormandPrince>(scene, 100.0);
  EXPECT_EQ(record.outcome, Outcome::event_budget);
  EXPECT_EQ(record.impacts, 11);
}

TEST(DormandPrinceMotion, that_overflows_is_an_outcome_and_not_a_motion) {
  const point::Problem usual = support::scene_of({0.1, 1.0, 0.8, 0.0}, -0.5, 0.5, 0.7);
  for (const double value : {infinity, -infinity, std::nan(""), 1e308, -1.7e308}) {
    point::Problem scene = usual;
    scene.start.velocity = value;
    EXPECT_EQ(support::record_by<DormandPrince>(scene, 20.0).outcome, Outcome::not_finite) << "v0 = " << value;
    scene.stops = {-infinity, infinity, 1.0, 1.0};
    EXPECT_EQ(support::record_by<DormandPrince>(scene, 20.0).outcome, Outcome::not_finite)
        << "v0 = " << value << ", no stops";
  }
  point::Problem forced = usual;
  forced.oscillator.forcing = infinity;
  EXPECT_EQ(support::record_by<DormandPrince>(forced, 20.0).outcome, Outcome::not_finite);
  point::Problem nowhere = usual;
  nowhere.start.displacement = std::nan("");
  EXPECT_EQ(support::record_by<DormandPrince>(nowhere, 20.0).outcome, Outcome::not_finite);
}

TEST(DormandPrinceMotion, too_short_steps_to_advance_time_are_unresolved) {
  const point::Problem scene =
      support::scene_of({1e18, 1.0, 0.8, 0.0}, -0.5, 0.5, 0.7);  // stable only in steps below 1e-18
  const auto method = support::general_method<DormandPrince>(scene);
  motion::State<double> state;
  state.phase_turns = 0.5, state.v = 0.1;
  EXPECT_EQ(method->advance(state, 1.0), Outcome::unresolved);
  EXPECT_LT(method->evaluations(), 1000);
}

}  // namespace
}  // namespace clatter::stepping::dormand_prince_motion_test
