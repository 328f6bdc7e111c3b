// Contact with soft stops by time stepping: a force that acts in whole steps, and an error that falls with the step.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "motion/soft_stop.hpp"
#include "stepping/moreau.hpp"
#include "support/methods.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::moreau_soft_stops_test {
namespace {

point::Problem soft_scene(double zeta) {
  point::Problem scene = support::scene_of({0.1, 1.0, 0.8, 0.1}, -0.5, 0.4, 0.6);
  scene.stops.stiffness_lower = 40, scene.stops.stiffness_upper = 90;
  scene.stops.damping_lower = scene.stops.damping_upper = zeta;
  scene.integration.method = Method::moreau;
  return scene;
}

TEST(MoreauSoftStops, the_error_falls_with_the_step) {
  for (const double zeta : {0.0, 0.2, 1.5}) {
    point::Problem scene = soft_scene(zeta);
    const double duration = 30;
    const auto exact = support::run_scene(scene, duration);
    ASSERT_GE(exact.record.touches.size(), 8u);
    std::vector<double> steps, errors;
    for (int n = 1 << 8; n <= 1 << 16; n *= 2) {
      scene.integration.step = 1.0 / n;
      support::Recorder record;
      const auto run = support::run_by<Moreau>(scene, duration, record);
      ASSERT_EQ(run.outcome, Outcome::completed);
      steps.push_back(scene.integration.step);
      errors.push_back(std::hypot(run.x - static_cast<double>(exact.end.x), run.v - static_cast<double>(exact.end.v)));
    }
    EXPECT_GT(support::order_of(steps, errors), 0.9) << zeta;  // contacts begin and end with a step
    EXPECT_LT(errors.back(), 1e-4) << zeta;
  }
}

TEST(MoreauSoftStops, contacts_are_those_of_the_exact_run_to_a_step) {
  for (const double zeta : {0.0, 0.2, 1.5}) {
    point::Problem scene = soft_scene(zeta);
    scene.integration.step = 1.0 / 20000;
    const double duration = 30, step = period_of(scene.oscillator) * scene.integration.step;
    support::Recorder record;
    const auto run = support::run_by<Moreau>(scene, duration, record);
    const auto exact = support::run_scene(scene, duration).record;
    ASSERT_EQ(record.touches.size(), exact.touches.size()) << zeta;
    ASSERT_EQ(record.separations.size(), exact.separations.size()) << zeta;
    EXPECT_EQ(run.impacts, static_cast<double>(record.touches.size()));
    for (std::size_t i = 0; i < record.touches.size(); ++i) {
      EXPECT_EQ(record.touches[i].side, exact.touches[i].side);
      EXPECT_EQ(record.touches[i].kind == motion::Event::Kind::touch,
                exact.touches[i].kind == motion::Event::Kind::touch);
      EXPECT_NEAR(record.touches[i].time, exact.touches[i].time, 8 * step);  // each contact before adds its error
      EXPECT_NEAR(record.touches[i].before, exact.touches[i].before, 1e-2);
    }
    for (std::size_t i = 0; i < record.separations.size(); ++i)
      EXPECT_NEAR(record.separations[i].time, exact.separations[i].time, 8 * step);
  }
}

/// Checks that the stop pushes in the middle of each step of a contact, and acts in no other step.
struct Pushes {
  Stops stops;
  int pushed = 0, free_beyond = 0;

  template <class A>
  void arc(const A& arc, double, double length) {
    const auto begin = arc.at(0.0);
    const double x = begin.x + length / 2 * begin.v;
    const motion::SoftStop<double>& own = arc.constants().stop;
    for (const Side side : {Side::lower, Side::upper}) {
      const auto stop = motion::soft_stop_at<double>(stops, side);
      const double depth = stop.into(x - stop.position), force = stop.force(depth, stop.into(begin.v));
      EXPECT_EQ(own.side == side, depth > 0 && force > 0);
      pushed += own.side == side, free_beyond += own.side != side && depth > 0;
    }
  }
  void event(const motion::Event& event) {
    if (event.kind == motion::Event::Kind::impact) ADD_FAILURE() << "an impact on a soft stop";
  }
};

TEST(MoreauSoftStops, a_stop_never_pulls_and_keeps_no_memory) {
  point::Problem scene = soft_scene(0.4);
  scene.integration.step = 1e-3;
  Pushes pushes{scene.stops};
  ASSERT_EQ((support::run_by<Moreau>(scene, 40.0, pushes).outcome), Outcome::completed);
  EXPECT_GT(pushes.pushed, 100);
  EXPECT_GT(pushes.free_beyond, 10);  // the mass outruns the stop on its way out
}

TEST(MoreauSoftStops, one_stop_may_be_rigid) {
  point::Problem scene = soft_scene(0.2);
  scene.stops.stiffness_upper = std::numeric_limits<double>::infinity();
  scene.integration.step = 1e-5;
  support::Recorder record;
  const auto run = support::run_by<Moreau>(scene, 30.0, record);
  const auto exact = support::run_scene(scene, 30.0);
  ASSERT_EQ(record.impacts.size(), exact.record.impacts.size());
  ASSERT_EQ(record.touches.size(), exact.record.touches.size());
  EXPECT_GE(record.impacts.size(), 3u);
  EXPECT_GE(record.touches.size(), 3u);
  EXPECT_NEAR(run.x, static_cast<double>(exact.end.x), 1e-3);
}

TEST(MoreauSoftStops, a_start_within_a_stop_is_no_touch) {
  point::Problem scene = soft_scene(0.2);
  scene.start.displacement = -0.6;
  scene.integration.step = 1e-4;
  support::Recorder record;
  ASSERT_EQ((support::run_by<Moreau>(scene, 1.0, record).outcome), Outcome::completed);
  ASSERT_EQ(record.separations.size(), 1u);
  EXPECT_EQ(record.touches.size(), support::run_scene(scene, 1.0).record.touches.size());
}

}  // namespace
}  // namespace clatter::stepping::moreau_soft_stops_test
