// The meaning of an impact: not that of a start into a stop, which comes before the observed time, and no touch at
// speed 0.

#include <gtest/gtest.h>

#include "sweep/figures.hpp"

namespace clatter::sweep::contact_meanings_test {
namespace {

point::Problem into_the_upper_stop(double v) {
  point::Problem scene;
  scene.oscillator = {0.1, 0.2, 1.4, 0.0};
  scene.stops = {-5, 1, 0.3, 0.3};
  scene.start = {1.0, v, 0.0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 20;
  scene.observe.extrema = scene.observe.impacts = true;
  return scene;
}

point::Problem mirrored(point::Problem scene) {
  scene.oscillator.forcing *= -1;
  scene.stops = {-scene.stops.upper, -scene.stops.lower, 0.3, 0.3};
  scene.start.displacement *= -1, scene.start.velocity *= -1;
  return scene;
}

/// The motion from just after the impact is the same, and its own extrema are what is observed.
void expect_start_after_impact(const point::Problem& into, const point::Problem& after, const RunOptions& options,
                               double tolerance) {
  const results::Dataset figure = run(sweep_of(into, {}), options).dataset,
                         same = run(sweep_of(after, {}), options).dataset;
  for (const char* const name : {"x_min", "x_max", "v_min", "v_max", "impacts_per_period"})
    for (std::size_t i = 0; i < values(figure, name).size(); ++i)
      EXPECT_NEAR(values(figure, name)[i], values(same, name)[i], tolerance) << name;
  EXPECT_LT(values(figure, "v_max")[0], 1.5);
  EXPECT_GT(values(figure, "v_min")[0], -1.5);
  const auto total = [](const results::Dataset& of) {
    return std::get<std::vector<std::int64_t>>(find(of, "impact_total")->values)[0];
  };
  EXPECT_EQ(total(figure), total(same) + 1);  // it is simulated all the same
}

TEST(StartOnStop, the_speed_before_its_impact_is_not_observed) {
  for (const lanes::InstructionSet arch :
       {lanes::InstructionSet::scalar, lanes::InstructionSet::sse2, lanes::widest_instruction_set()}) {
    const RunOptions options{.threads = 1, .arch = arch};  // -0.3 * 2 is an ulp off -0.6
    expect_start_after_impact(into_the_upper_stop(2.0), into_the_upper_stop(-0.6), options, 1e-13);
    expect_start_after_impact(mirrored(into_the_upper_stop(2.0)), mirrored(into_the_upper_stop(-0.6)), options, 1e-13);
  }
}

TEST(StartOnStop, nor_by_general_methods) {
  for (const stepping::Method method : {stepping::Method::dopri5, stepping::Method::moreau}) {
    point::Problem into = into_the_upper_stop(2.0), after = into_the_upper_stop(-0.6);
    into.integration.method = after.integration.method = method;
    expect_start_after_impact(into, after, {.threads = 1}, 1e-8);  // the size of steps depends on the start
    expect_start_after_impact(mirrored(into), mirrored(after), {.threads = 1}, 1e-8);
  }
}

/// Free motion of amplitude 1 with the stops exactly there.
point::Problem touching(steady::Mode mode, double R) {
  point::Problem scene;
  scene.stops = {-1, 1, R, R};
  scene.start.velocity = 1;
  scene.time.mode = mode, scene.time.duration = 3;  // up to the first touch; later ones hang on rounding
  scene.observe.extrema = scene.observe.impacts = scene.observe.impact_log = scene.observe.period = true;
  return scene;
}

TEST(Touch, at_speed_0_is_no_impact) {
  for (const steady::Mode mode : {steady::Mode::transient, steady::Mode::steady})
    for (const double R : {0.0, 0.7, 1.0}) {
      if (mode == steady::Mode::steady && R < 1) continue;
      const RunResult result = run(sweep_of(touching(mode, R), {}), {.threads = 1});
      EXPECT_EQ(values(result.dataset, "impacts_per_period"), (std::vector<double>{0, 0})) << R;
      EXPECT_TRUE(values(result.dataset, "impact_tau").empty()) << R;
      EXPECT_TRUE(std::isnan(values(result.dataset, "velocity_ratio")[0])) << R;
      EXPECT_EQ(values(result.dataset, "x_max")[0], 1.0);
      if (mode == steady::Mode::steady) {
        EXPECT_NEAR(values(result.dataset, "period")[0], 2 * pi<double>(), 1e-14);
      }
    }
}

TEST(Chatter, is_told_impact_by_impact_however_low_its_first_rebound_is) {
  // pressed by its load; thrown up with the speed 1e-9 it rises to 0.5e-18, and each rebound to a quarter of that
  // before
  point::Problem scene;
  scene.oscillator = {0.1, 0.0, 1.0, 2.0};
  scene.stops = {-5, 1, 0.5, 0.5};
  scene.start = {1.0, -1e-9, 0.0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 1;
  scene.observe.extrema = scene.observe.impacts = true;
  const results::Dataset figure = run(sweep_of(scene, {}), {.threads = 1}).dataset;
  EXPECT_EQ(values(figure, "impacts_per_period")[1], 20);  // 4^-20 < 1e-12
  EXPECT_NEAR(values(figure, "v_before")[1], 1e-9, 1e-15);
  EXPECT_NEAR(values(figure, "v_after")[1], -0.5e-9, 1e-15);
  EXPECT_NEAR(values(figure, "rest_fraction")[1], 1, 1e-8);
}

}  // namespace
}  // namespace clatter::sweep::contact_meanings_test
