// Motion between soft stops: closed forms, 50 digits, a general solver, and the limit of rigid stops.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "math/fifty_digits.hpp"
#include "stepping/dormand_prince.hpp"
#include "support/methods.hpp"
#include "support/runs.hpp"
#include "support/scene_range.hpp"
#include "support/soft_scene.hpp"

namespace clatter::stepping::soft_stops_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

point::Problem between_soft(const Oscillator& oscillator, double g, double kappa, double zeta) {
  point::Problem scene = support::scene_of(oscillator, -g, g, 1.0);
  scene.stops.stiffness_lower = scene.stops.stiffness_upper = kappa;
  scene.stops.damping_lower = scene.stops.damping_upper = zeta;
  return scene;
}

TEST(SoftStops, free_motion_has_the_period_of_the_closed_form) {
  for (const double kappa : {0.5, 10.0, 1e4, 1e8})
    for (const double V : {1.2, 5.0}) {
      point::Problem scene = between_soft({}, 1.0, kappa, 0.0);
      scene.start.velocity = V;
      const double stiff = std::sqrt(1 + kappa), far = std::sqrt(V * V - 1);
      const double period = 4 * (std::asin(1 / V) + std::atan(stiff * far) / stiff);
      const auto run = support::run_scene(scene, 100.5 * period);
      std::vector<double> upper;
      for (const motion::Event& touch : run.record.touches)
        if (touch.side == Side::upper) upper.push_back(touch.time);
      ASSERT_GE(upper.size(), 101u);
      // a clock that counts in periods of 2 pi rounds each time to its ulp, and each contact adds one
      EXPECT_NEAR((upper[100] - upper[0]) / 100, period, 8 * epsilon<double>() * upper[100]) << kappa << ' ' << V;
      // nothing is lost: each of 200 contacts may round the energy once
      EXPECT_NEAR(run.record.separations.back().before, far * -sign_of(run.record.separations.back().side),
                  200 * epsilon<double>() * V * V / far);
    }
}

TEST(SoftStops, a_damped_contact_has_the_duration_and_the_restitution_of_the_closed_form) {
  for (const double zeta : {0.0, 0.01, 0.3, 0.9, 0.9999})
    for (const double kappa : {1.0, 1e6, 1e12}) {
      point::Problem scene = between_soft({.stiffness = 0.0}, 1.0, kappa, zeta);
      scene.start.velocity = 1.5;
      const auto run = support::run_scene(scene, 1.0 / 1.5 + 10 / std::sqrt(kappa));
      const double angle = std::acos(zeta) / std::sqrt((1 - zeta) * (1 + zeta));
      ASSERT_GE(run.record.separations.size(), 1u);
      const motion::Event touch = run.record.touches[0];
      const motion::Event end = run.record.separations[0];
      EXPECT_NEAR(touch.before, 1.5, 4 * epsilon<double>());
      EXPECT_NEAR(end.after, -1.5 * std::exp(-2 * zeta * angle), 64 * epsilon<double>()) << zeta << ' ' << kappa;
      const double clock = 16 * epsilon<double>() * touch.time;  // both times are read off it
      EXPECT_NEAR(end.time - touch.time, 2 * angle / std::sqrt(kappa),
                  64 * epsilon<double>() / std::sqrt(kappa) + clock);
    }
}

/// The derivative of the end of a run by its start, at most.
double growth(const point::Problem& scene, double duration) {
  const auto end = [&](double x, double v) {
    point::Problem moved = scene;
    const Stops rigid = rigid_ones(scene.stops);  // beyond which nothing may start
    moved.start.displacement = std::clamp(moved.start.displacement + x, rigid.lower, rigid.upper);
    moved.start.velocity += v;
    const auto run = support::run_scene(moved, duration);
    return PhasePoint{run.end.x, run.end.v};
  };
  const PhasePoint there = end(0, 0);
  double most = 1;
  for (const double small : {1e-7, -1e-7})
    for (const auto& [x, v] : {std::pair{small, 0.0}, std::pair{0.0, small}}) {
      const PhasePoint other = end(x, v);
      most = std::max(most, std::max(std::abs(other.x - there.x), std::abs(other.v - there.v)) / 1e-7);
    }
  return most;
}

/// How far an error of a run moves its end: the most that one does that is made at its start, or on its way.
double sensitivity(const point::Problem& scene, double duration) {
  constexpr int parts = 8;
  double most = 1;
  for (int part = 0; part < parts; ++part) {
    const double begin = duration * part / parts;
    const auto run = support::run_scene(scene, begin);
    point::Problem rest = scene;
    rest.start = {run.end.x, run.end.v, scene.start.phase + counting_frequency(scene.oscillator) * begin};
    most = std::max(most, growth(rest, duration - begin));
  }
  return most;
}

TEST(SoftStops, random_motion_agrees_with_fifty_digits) {
  const support::SceneRange range = support::scene_range(60);
  for (std::uint64_t i = range.from; i < range.to; ++i) {
    const point::Problem scene = support::soft_scene(i);
    const double duration = scene.time.duration;
    const auto run = support::run_scene(scene, duration);
    const auto reference = support::run_scene<FiftyDigits>(scene, duration);
    ASSERT_EQ(run.outcome, Outcome::completed) << i;
    // rounding of every contact moves the state by an ulp, and each grows by the sensitivity at most
    const double allowed =
        64 * epsilon<double>() * sensitivity(scene, duration) * static_cast<double>(2 + run.record.touches.size());
    EXPECT_NEAR(run.end.x, static_cast<double>(reference.end.x), allowed) << i;
    EXPECT_NEAR(run.end.v, static_cast<double>(reference.end.v), allowed * std::sqrt(1 + scene.stops.stiffness_lower))
        << i;
    // not the impacts on rigid stops: 50 digits take many more of a chatter one by one
    EXPECT_EQ(run.record.touches.size(), reference.record.touches.size()) << i;
    EXPECT_EQ(run.record.separations.size(), reference.record.separations.size()) << i;
  }
}

TEST(SoftStops, random_motion_agrees_with_a_general_solver) {
  const support::SceneRange range = support::scene_range(300);
  for (std::uint64_t i = range.from; i < range.to; ++i) {
    point::Problem scene = support::soft_scene(i);
    scene.integration.method = Method::dopri5, scene.integration.tolerance = 1e-12;
    const double duration = scene.time.duration;
    const auto run = support::run_scene(scene, duration);
    support::EventList events;
    const accuracy::RunRecord solved = support::run_by<DormandPrince>(scene, duration, events);
    ASSERT_EQ(solved.outcome, Outcome::completed) << i;
    // each of its steps has an error of 1e-12 of the motion's size; those of a contact move the rest of the motion
    const double allowed = 1e-12 * sensitivity(scene, duration) * (2 + solved.evaluations / 6);
    EXPECT_NEAR(run.end.x, solved.x, allowed) << i;
    EXPECT_NEAR(run.end.v, solved.v, allowed * std::sqrt(1 + scene.stops.stiffness_lower)) << i;
  }
}

/// Checks on samples that every arc is where it belongs: outside the stops, pressed by one, or beyond one that it
/// outruns. Forces are over kappa, so that they are lengths.
struct ModeCheck {
  const Stops& stops;
  double worst = 0;  ///< by which a condition is broken
  double size = 1;   ///< of the motion

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto pressed = arc.constants().stop;
    for (int i = 0; i <= 64; ++i) {
      const motion::Motion<double> m = arc.at(length * i / 64);
      size = std::max({size, std::abs(m.x), std::abs(m.v)});
      if (pressed.side != Side::none) {
        worst = std::max(worst, -(pressed.into(m.offset) + pressed.relaxation() * pressed.into(m.v)));
        continue;
      }
      for (const Side side : {Side::lower, Side::upper}) {
        if (!is_soft(stops, side)) continue;
        const auto stop = motion::soft_stop_at<double>(stops, side);
        const double depth = stop.into(m.x - stop.position);
        if (depth > 0) worst = std::max(worst, std::min(depth, depth + stop.relaxation() * stop.into(m.v)));
      }
    }
  }
  void event(const motion::Event&) {}
};

TEST(SoftStops, no_contact_and_no_separation_is_missed) {
  const support::SceneRange range = support::scene_range(1000);
  for (std::uint64_t i = range.from; i < range.to; ++i) {
    const point::Problem scene = support::soft_scene(i);
    ModeCheck check{scene.stops};
    const auto run = [&]<Effects effects>() {
      Exact<double, effects> integrator(scene, limits_of(scene));
      motion::State<double> state;
      state.x = scene.start.displacement, state.v = scene.start.velocity;
      ASSERT_EQ(run_for(integrator, state, scene.time.duration / integrator.period(), check), Outcome::completed) << i;
    };
    if (rotates(scene.oscillator))
      run.operator()<effect_sets::with_soft_stops(Damping::light, Forcing::secular)>();
    else
      run.operator()<effect_sets::with_soft_stops(Damping::heavy, Forcing::regular)>();
    // some ulps of displacements and velocities; a relaxation time is up to 60
    EXPECT_LT(check.worst, 1e-13 * check.size) << i;
  }
}

TEST(SoftStops, stiffer_ones_tend_to_rigid_ones_as_the_root_of_their_compliance) {
  for (const double zeta : {0.0, 0.1}) {
    const double R = std::exp(-2 * zeta * std::acos(zeta) / std::sqrt(1 - zeta * zeta));
    const Oscillator oscillator{0.1, 1.0, 1.3, 0.0};
    const auto rigid = support::run_scene(support::scene_of(oscillator, -0.3, 0.3, R), 6.0);
    std::vector<double> compliances, errors;
    for (const double kappa : {1e6, 1e8, 1e10, 1e12}) {
      const auto soft = support::run_scene(between_soft(oscillator, 0.3, kappa, zeta), 6.0);
      ASSERT_EQ(soft.record.touches.size(), rigid.record.impacts.size());
      compliances.push_back(1 / kappa);
      errors.push_back(std::abs(soft.record.touches.back().before - rigid.record.impacts.back().before));
    }
    EXPECT_NEAR(support::order_of(compliances, errors), 0.5, 0.02) << zeta;
  }
}

TEST(SoftStops, a_mass_that_a_damper_holds_back_leaves_it_inside_the_stop_and_may_meet_it_again) {
  point::Problem scene = between_soft({0.0, 0.0, 1.0, 0.0}, 1.0, 4.0, 3.0);
  scene.oscillator.load = 3.0, scene.stops.lower = -infinity;  // pulls it back into the stop that it has outrun
  scene.oscillator.forcing = 5.0, scene.oscillator.frequency = 20.0;
  const auto run = support::run_scene(scene, 200.0);
  EXPECT_EQ(run.outcome, Outcome::completed);
  EXPECT_TRUE(std::ranges::any_of(run.record.touches,
                                  [](const motion::Event& touch) { return touch.kind != motion::Event::Kind::touch; }));
  const auto reference = support::run_scene<FiftyDigits>(scene, 200.0);
  EXPECT_EQ(run.record.touches.size(), reference.record.touches.size());
  EXPECT_NEAR(run.end.x, static_cast<double>(reference.end.x), 1e-13);  // some hundred contacts, each damped away
}

TEST(SoftStops, an_equilibrium_exactly_on_a_stop_neither_hangs_nor_moves) {
  point::Problem scene = between_soft({0.1, 0.0, 1.0, 1.0}, 1.0, 100.0, 0.1);
  scene.start.displacement = 1.0;
  const auto run = support::run_scene(scene, 50.0);
  EXPECT_EQ(run.outcome, Outcome::completed);
  EXPECT_EQ(run.end.x, 1.0);
  EXPECT_EQ(run.end.v, 0.0);
}

}  // namespace
}  // namespace clatter::stepping::soft_stops_test
