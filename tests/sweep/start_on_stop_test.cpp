// A start that stands on a stop and moves into it: the observed time (0, T] begins after that impact.

#include <gtest/gtest.h>

#include "sweep/figures.hpp"

namespace clatter {
namespace {

Scene into_the_upper_stop(double v) {
  Scene scene;
  scene.oscillator = {0.1, 0.2, 1.4, 0.0};
  scene.stops = {-5, 1, 0.3, 0.3};
  scene.start = {1.0, v, 0.0};
  scene.time.mode = Mode::transient, scene.time.duration = 20;
  scene.observe.extrema = scene.observe.impacts = true;
  return scene;
}

Scene mirrored(Scene scene) {
  scene.oscillator.forcing *= -1;
  scene.stops = {-scene.stops.upper, -scene.stops.lower, 0.3, 0.3};
  scene.start.displacement *= -1, scene.start.velocity *= -1;
  return scene;
}

/// The motion from just after the impact is the same, and its own extrema are what is observed.
void expect_start_after_impact(const Scene& into, const Scene& after, const RunOptions& options, double tolerance) {
  const Figure figure = run(sweep_of(into, {}), options).figure, same = run(sweep_of(after, {}), options).figure;
  for (const char* const name : {"x_min", "x_max", "v_min", "v_max", "impacts_per_period"})
    for (std::size_t i = 0; i < values(figure, name).size(); ++i)
      EXPECT_NEAR(values(figure, name)[i], values(same, name)[i], tolerance) << name;
  EXPECT_LT(values(figure, "v_max")[0], 1.5);
  EXPECT_GT(values(figure, "v_min")[0], -1.5);
  const auto total = [](const Figure& of) {
    return std::get<std::vector<std::int64_t>>(find(of, "impact_total")->values)[0];
  };
  EXPECT_EQ(total(figure), total(same) + 1);  // it is simulated all the same
}

TEST(StartOnStop, the_speed_before_its_impact_is_not_observed) {
  for (const Arch arch : {Arch::scalar, Arch::sse2, best_arch()}) {
    const RunOptions options{.threads = 1, .arch = arch};  // -0.3 * 2 is an ulp off -0.6
    expect_start_after_impact(into_the_upper_stop(2.0), into_the_upper_stop(-0.6), options, 1e-13);
    expect_start_after_impact(mirrored(into_the_upper_stop(2.0)), mirrored(into_the_upper_stop(-0.6)), options, 1e-13);
  }
}

TEST(StartOnStop, nor_by_general_methods) {
  for (const Method method : {Method::dopri5, Method::moreau}) {
    Scene into = into_the_upper_stop(2.0), after = into_the_upper_stop(-0.6);
    into.integration.method = after.integration.method = method;
    expect_start_after_impact(into, after, {.threads = 1}, 1e-8);  // the size of steps depends on the start
    expect_start_after_impact(mirrored(into), mirrored(after), {.threads = 1}, 1e-8);
  }
}

}  // namespace
}  // namespace clatter
