// A transient that decays slowly and turns with the force by thirds of a period, as free motion does near nu = 3: after
// three periods it is back to a thousandth of what is left of it. It has to be gone before the motion counts as
// settled, whoever looks for the repeat, and the period is one.

#include <gtest/gtest.h>

#include "point/point.hpp"
#include "scene/response.hpp"

namespace clatter::point::slow_decay_test {
namespace {

Problem decaying(double nu) {
  Problem scene;
  scene.oscillator = {2e-4, 1.0, nu, 0.0};
  scene.stops = {-2, 2, 0.7, 0.7};
  scene.start = {0.3, 0.2, 0.0};
  scene.time.max_periods = 100000;
  scene.observe = {};
  scene.observe.extrema = true;
  scene.observe.period = true;
  return scene;
}

void expect_settled(const Problem& scene, const PointResult& result, double tolerance) {
  const double A = steady_response(2e-4, 1.0, scene.oscillator.frequency).amplitude;
  EXPECT_EQ(result.status, steady::Status::periodic);
  EXPECT_EQ(result.period_ratio, 1.0);
  EXPECT_NEAR(result.x_max, A, tolerance);
  EXPECT_NEAR(result.x_min, -A, tolerance);
  EXPECT_GT(result.settling_estimate, 50000);  // 27.6/(h T)
}

TEST(SlowDecay, is_waited_for_by_repetition_and_with_all_effects) {
  for (const double nu : {2.9995, 3.0, 3.001})
    for (const bool all : {false, true}) {
      Problem scene = decaying(nu);
      scene.integration.shortcuts = false, scene.integration.all_effects = all;
      ThreadScratch scratch;
      expect_settled(scene, run_point(scene, scratch), 3e-12);
    }
}

TEST(SlowDecay, that_max_periods_cut_off_is_no_period) {
  Problem scene = decaying(3.0);
  scene.integration.all_effects = true;
  scene.time.max_periods = 45000;  // 1e-9 of it is left
  ThreadScratch scratch;
  EXPECT_EQ(run_point(scene, scratch).status, steady::Status::aperiodic);
}

TEST(SlowDecay, is_waited_for_by_a_general_method) {
  Problem scene = decaying(3.0);
  scene.integration.method = stepping::Method::dopri5, scene.integration.tolerance = 1e-12;
  ThreadScratch scratch;
  expect_settled(scene, run_point(scene, scratch), 1e-9);
}

TEST(SlowDecay, is_known_at_once_in_closed_form_with_its_estimate) {
  const Problem scene = decaying(3.0);
  ThreadScratch scratch;
  const PointResult result = run_point(scene, scratch);
  expect_settled(scene, result, 1e-15);
  EXPECT_EQ(result.periods, 1.0);
  Problem slower = scene;  // it settles, but nobody waits for it
  slower.oscillator.damping = 1e-10;
  const PointResult late = run_point(slower, scratch);
  EXPECT_EQ(late.status, steady::Status::periodic);
  EXPECT_GT(late.settling_estimate, 1e11);
}

}  // namespace
}  // namespace clatter::point::slow_decay_test
