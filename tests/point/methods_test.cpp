// General methods fill the same results as the exact one, and their values come to its.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "point/point.hpp"
#include "sweep/figures.hpp"

namespace clatter::point::methods_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t samples = 1024;

observables::Observe everything(observables::HarmonicsMethod harmonics) {
  observables::Observe observe;
  observe.extrema = observe.impacts = observe.impact_log = observe.full_log = observe.period = observe.stability = true;
  observe.harmonics = 3, observe.harmonics_method = harmonics;
  observe.harmonics_samples = static_cast<std::int64_t>(samples);
  observe.trajectory = 33;
  return observe;
}

PointResult result_of(const Problem& scene) {
  ThreadScratch scratch{observables::Harmonics::scratch_for(scene.observe)};
  return run_point(scene, scratch);
}

struct Named {
  std::string name;
  Problem scene;
};

Problem scene_of(const Oscillator& oscillator, double lower, double upper, double R) {
  Problem scene;
  scene.oscillator = oscillator;
  scene.stops = {lower, upper, R, R};
  return scene;
}

/// Forced and free, with rests and without, steady and transient.
std::vector<Named> scenes() {
  std::vector<Named> all{{"symmetric", sweep::paper_scene(0.5, 1.0)},
                         {"asymmetric, 3 periods", scene_of({0.1, -1.0, 0.8, 0.15}, -0.5, 0.3, 0.7)},
                         {"one stop", scene_of({0.1, -1.0, 1.2, 0.0}, -0.5, infinity, 0.7)},
                         {"without impact", scene_of({0.1, -1.0, 1.2, 0.0}, -5.0, 5.0, 0.7)},
                         {"chatter", scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.5)},
                         {"rest", scene_of({0.1, 1.0, 0.5, 0.0}, -0.5, 0.5, 0.0)},
                         {"heavy", scene_of({1.5, 3.0, 0.7, 0.0}, -0.5, 0.5, 0.3)},
                         {"conservative", scene_of({0.0, 0.0, 1.0, 0.0}, -0.749, 0.749, 1.0)},
                         {"fading", scene_of({0.1, 0.0, 1.0, 0.0}, -1.0, 1.0, 0.7)},
                         {"held", scene_of({0.1, 0.0, 1.0, 2.0}, -1.0, 1.0, 0.7)},
                         {"too short to repeat", scene_of({0.1, -1.0, 0.9, 0.0}, -3.0, 3.0, 0.7)},
                         {"transient", sweep::paper_scene(0.5, 1.0)},
                         {"transient without force", scene_of({0.1, 0.0, 1.0, 0.0}, -0.5, 0.5, 0.7)}};
  all[1].scene.stops.restitution_upper = 0.8;
  for (auto& [name, scene] : all) {
    if (scene.oscillator.forcing == 0) scene.start = {0.3, -1.25, 0.0}, scene.time.tolerance = 1e-8;
    if (name == "held") scene.start = {};
    if (name == "too short to repeat") scene.time.max_periods = 3, scene.time.window = 2;
    if (name.starts_with("transient")) scene.time.mode = steady::Mode::transient, scene.time.duration = 17.0;
  }
  return all;
}

/// A result's numbers, by what they are called; none of what has no value, such as the phase of an amplitude of 0.
struct Number {
  std::string name;
  double value;
};
std::vector<Number> numbers_of(const PointResult& r) {
  std::vector<Number> n{{"status", static_cast<double>(r.status)},
                        {"observed_turns", r.observed_turns},
                        {"x_min", r.x_min},
                        {"x_max", r.x_max},
                        {"v_min", r.v_min},
                        {"v_max", r.v_max},
                        {"base_frequency", r.base_frequency},
                        {"period", r.period},
                        {"period_ratio", r.period_ratio},
                        {"eigenfrequency", r.eigenfrequency},
                        {"velocity_ratio", r.velocity_ratio},
                        {"lyapunov", r.lyapunov}};
  for (const std::size_t stop : {0u, 1u}) {
    const std::string at = stop == 0 ? " 0" : " 1";
    n.push_back({"impacts_per_period" + at, r.impacts_per_period[stop]});
    n.push_back({"v_before" + at, r.v_before[stop]}), n.push_back({"v_after" + at, r.v_after[stop]});
    n.push_back({"impact_speed" + at, r.impact_speed[stop]});
    n.push_back({"rest_fraction" + at, r.rest_fraction[stop]});
    n.push_back({"multiplier_re" + at, r.multiplier_re[stop]});
    n.push_back({"multiplier_im" + at, r.multiplier_im[stop]});
  }
  for (const observables::Spectrum* spectrum : {&r.x_spectrum, &r.v_spectrum})
    for (std::size_t k = 0; k < spectrum->amplitude.size(); ++k) {
      const double phase = k == 0 ? 0.0 : spectrum->phase[k];
      n.push_back({"cosine amplitude " + std::to_string(k), spectrum->amplitude[k] * std::cos(phase)});
      n.push_back({"sine amplitude " + std::to_string(k), spectrum->amplitude[k] * std::sin(phase)});
    }
  for (std::size_t i = 0; i < r.tau.size(); ++i) n.push_back({"tau", r.tau[i]}), n.push_back({"x", r.x[i]});
  return n;
}

/// Largest difference of two results; infinite if one has a value that the other doesn't have.
double difference(const PointResult& a, const PointResult& b, const std::string& name) {
  const auto of_a = numbers_of(a), of_b = numbers_of(b);
  EXPECT_EQ(of_a.size(), of_b.size()) << name;
  double worst = 0;
  for (std::size_t i = 0; i < std::min(of_a.size(), of_b.size()); ++i) {
    const double x = of_a[i].value, y = of_b[i].value;
    if (x == y || (std::isnan(x) && std::isnan(y))) continue;
    EXPECT_EQ(std::isfinite(x), std::isfinite(y)) << name << ": " << of_a[i].name << " " << x << " " << y;
    const double d = std::abs(x - y) / std::max(1.0, std::abs(x));
    worst = std::isfinite(d) ? std::max(worst, d) : infinity;
  }
  return worst;
}

TEST(Methods, dopri5_fills_and_comes_to_the_results_of_the_exact_method) {
  for (const observables::HarmonicsMethod harmonics :
       {observables::HarmonicsMethod::fft, observables::HarmonicsMethod::exact})
    for (auto& [name, scene] : scenes()) {
      scene.observe = everything(harmonics);
      const PointResult exact = result_of(scene);
      scene.integration.method = stepping::Method::dopri5;
      // motion counts as come to stand still, or back, within the repeat's tolerance
      const double repeated = name == "fading" ? scene.time.tolerance : 1e-12;
      for (const double tolerance : {1e-9, 1e-11, 1e-13}) {
        scene.integration.tolerance = tolerance;
        const PointResult result = result_of(scene);
        EXPECT_LT(difference(result, exact, name), 100 * tolerance + repeated) << name << ", " << tolerance;
        EXPECT_EQ(result.log.size(), exact.log.size()) << name;
        EXPECT_EQ(result.rests.size(), exact.rests.size()) << name << ", " << tolerance;
        EXPECT_GT(result.evaluations, 0.0) << name;
      }
    }
}

TEST(Methods, moreau_fills_the_results_of_the_exact_method) {
  for (const observables::HarmonicsMethod harmonics :
       {observables::HarmonicsMethod::fft, observables::HarmonicsMethod::exact})
    for (auto& [name, scene] : scenes()) {
      scene.observe = everything(harmonics);
      const PointResult exact = result_of(scene);
      scene.integration.method = stepping::Method::moreau;
      scene.integration.step = 1e-3;
      const PointResult result = result_of(scene);
      EXPECT_EQ(result.status, exact.status) << name;
      EXPECT_LT(difference(result, exact, name), infinity) << name;
    }
}

TEST(Methods, moreau_comes_to_the_results_of_the_exact_method) {
  // steady motion with impacts may lock into several periods that differ by a step: it is left out
  const std::vector<std::string> compared{"without impact", "rest", "held", "transient", "transient without force"};
  for (auto& [name, scene] : scenes()) {
    if (std::ranges::find(compared, name) == compared.end()) continue;
    scene.observe = everything(observables::HarmonicsMethod::exact);
    const PointResult exact = result_of(scene);
    scene.integration.method = stepping::Method::moreau;
    for (const double step : {1.0 / 256, 1.0 / 1024, 1.0 / 4096}) {
      scene.integration.step = step;
      const PointResult result = result_of(scene);
      // at speeds near 1 by a few impacts that are late by up to a step, some of which make up for others
      EXPECT_LT(difference(result, exact, name), 2 * 2 * std::numbers::pi * step) << name << ", " << step;
      EXPECT_EQ(result.log.size(), exact.log.size()) << name;
    }
  }
}

TEST(Methods, motion_that_rests_throughout_has_no_period) {
  Problem scene = sweep::paper_scene(1.0, 1.0);
  scene.oscillator.load = 3.0;
  scene.observe.period = scene.observe.impacts = true;
  for (const stepping::Method method : {stepping::Method::exact, stepping::Method::dopri5, stepping::Method::moreau}) {
    scene.integration.method = method;
    const PointResult result = result_of(scene);
    EXPECT_EQ(result.status, steady::Status::periodic);
    EXPECT_TRUE(std::isnan(result.period)) << result.period;
    EXPECT_NEAR(result.rest_fraction[1], 1.0, 1e-12);  // a sum of a thousand steps
  }
}

TEST(Methods, an_impact_in_the_first_step_is_observed) {
  Problem scene = scene_of({0.1, 1.0, 0.8, 0.0}, -0.5, 0.5, 0.7);
  scene.start = {0.5 - 1e-4, 1.0, 0.0};
  scene.time.mode = steady::Mode::transient, scene.time.duration = 0.1;
  scene.observe = everything(observables::HarmonicsMethod::exact);
  scene.integration.step = 1e-3;  // 0.008 of tau: the contact is in its first half
  for (const stepping::Method method : {stepping::Method::exact, stepping::Method::dopri5, stepping::Method::moreau})
    for (const double theta : {0.0, 0.5, 1.0}) {
      scene.integration.method = method, scene.integration.theta = theta;
      const PointResult result = result_of(scene);
      EXPECT_EQ(result.impacts, 1) << theta;
      EXPECT_EQ(result.impacts_per_period[1], 1) << theta;
      ASSERT_EQ(result.log.size(), 1u) << theta;
      EXPECT_NEAR(result.log[0].time, 1e-4, 0.008);
    }
}

TEST(Methods, with_all_effects_dopri5_runs_to_the_end_and_finds_the_same_motion) {
  for (auto& [name, scene] : scenes()) {
    scene.observe = everything(observables::HarmonicsMethod::exact);
    scene.integration.method = stepping::Method::dopri5, scene.integration.tolerance = 1e-11;
    EXPECT_EQ(effects_of(scene), general_effects(scene.oscillator));
    if (scene.time.max_periods > 300) scene.time.max_periods = 300;
    const PointResult some = result_of(scene);
    scene.integration.all_effects = true;
    EXPECT_EQ(effects_of(scene), general_effects(scene.oscillator));
    const PointResult all = result_of(scene);
    EXPECT_LT(difference(some, all, name), name == "fading" ? scene.time.tolerance : 1e-11) << name;
    if (some.status == steady::Status::periodic && scene.oscillator.forcing != 0) {
      EXPECT_GT(all.periods, 100) << name;
      EXPECT_EQ(all.found_by, steady::FoundBy::repetition) << name;
    }
  }
}

TEST(Methods, without_shortcuts_the_exact_method_finds_the_same_motion_by_repetition) {
  int shorter = 0;
  for (auto& [name, scene] : scenes()) {
    scene.observe = everything(observables::HarmonicsMethod::exact);
    scene.time.tolerance = 1e-14;
    const PointResult with = result_of(scene);
    scene.integration.shortcuts = false;
    const PointResult without = result_of(scene);
    EXPECT_LT(difference(without, with, name), 1e-12) << name;  // the repeat's tolerance over what a period forgets
    EXPECT_EQ(without.log.size(), with.log.size()) << name;
    if (without.status == steady::Status::periodic && scene.oscillator.forcing != 0) {
      EXPECT_EQ(without.found_by, steady::FoundBy::repetition) << name;
    }
    EXPECT_GE(without.periods, with.periods) << name;
    shorter += without.periods > with.periods;
  }
  EXPECT_GE(shorter, 3);
}

}  // namespace
}  // namespace clatter::point::methods_test
