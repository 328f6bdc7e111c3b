// No shortcut may end on a motion to which the scene itself doesn't settle: random scenes, light damping near low
// ratios first, against simulating everything for all of max_periods.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

#include "lanes/run_in_lanes.hpp"
#include "point/point.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/response.hpp"
#include "support/random.hpp"
#include "support/runs.hpp"
#include "support/scene_range.hpp"

namespace clatter::hard::attractors_test {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

point::Problem steady_scene(const Oscillator& oscillator, double lower, double upper, double R) {
  point::Problem scene = support::scene_of(oscillator, lower, upper, R);
  scene.observe.extrema = scene.observe.period = true;
  return scene;
}

double ratio_near(support::Random& random) {
  constexpr std::array ratios{1.0 / 3, 0.5, 2.0 / 3, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0};
  const auto which = static_cast<std::size_t>(random.uniform(0, static_cast<double>(ratios.size())));
  return ratios[which] * (1 + random.sign() * random.logarithmic(1e-4, 2e-2));
}

/// A transient that beats slowly with the force, with the stops somewhere in its reach.
point::Problem beats(support::Random& random, double least_h, double most_h) {
  const double h = random.logarithmic(least_h, most_h), nu = ratio_near(random);
  const double response = steady_response(h, 1.0, nu).amplitude, transient = response * random.logarithmic(0.1, 10);
  const double xs = response + transient * random.uniform(0.02, 1.1), angle = random.uniform(0, 2 * pi<double>());
  point::Problem scene = steady_scene({h, 1.0, nu, 0.0}, -xs, xs, random.uniform(0.4, 0.97));
  const PhasePoint start = response_at(scene.oscillator, 0.0, 1.0);
  scene.start = {std::clamp(start.x + transient * std::cos(angle), -0.999 * xs, 0.999 * xs),
                 start.v + transient * std::sin(angle), 0.0};
  scene.time.max_periods = 400 + static_cast<std::int64_t>(45 / (h * period_of(scene.oscillator)));
  return scene;
}

point::Problem start_anywhere(support::Random& random, point::Problem scene) {
  const double low = std::max(scene.stops.lower, -3.0), high = std::min(scene.stops.upper, 3.0);
  if (random.happens(0.7)) scene.start = {random.uniform(low, high), random.uniform(-2, 2), random.uniform(-3, 3)};
  if (scene.stops.lower > 0 || scene.stops.upper < 0) scene.start.displacement = (low + high) / 2;
  return scene;
}

/// One kind of scene after the other.
point::Problem scene_number(std::uint64_t i) {
  support::Random random(17, i);
  const double xs = random.logarithmic(0.1, 5), nu = random.logarithmic(0.3, 6);
  switch (i % 9) {
    case 0:
      return beats(random, 6e-5, 6e-4);
    case 1:
      return beats(random, 6e-4, 1e-2);
    case 2:  // subharmonics with many impacts
      return start_anywhere(
          random, steady_scene({random.logarithmic(0.01, 0.3), -1.0, nu, 0.0}, -xs, xs, random.uniform(0.3, 0.95)));
    case 3:  // nearly elastic
      return start_anywhere(random, steady_scene({random.logarithmic(1e-3, 0.1), 1.0, nu, 0.0}, -xs, xs,
                                                 1 - random.logarithmic(1e-4, 0.1)));
    case 4:  // near the period doublings of Figs. 22 and 23
      return steady_scene({random.uniform(0.08, 0.12), -1.0, random.uniform(0.84, 1.0), 0.0}, -3.0,
                          random.uniform(2.9, 4.1), random.uniform(0.6, 0.8));
    case 5: {  // unlike stops under a load
      point::Problem scene =
          steady_scene({random.logarithmic(1e-3, 0.5), 1.0, nu, random.uniform(-0.5, 0.5)}, -random.logarithmic(0.1, 3),
                       random.logarithmic(0.1, 3), random.uniform(0.2, 0.9));
      scene.stops.restitution_upper = random.uniform(0.2, 0.9);
      return start_anywhere(random, scene);
    }
    case 6:  // chatter and rest
      return start_anywhere(
          random, steady_scene({random.logarithmic(0.01, 0.3), 1.0, random.uniform(0.1, 1.0), 0.0},
                               -random.uniform(0.05, 0.9), random.uniform(0.05, 0.9), random.uniform(0, 0.8)));
    case 7:  // one stop
      return start_anywhere(random, steady_scene({random.logarithmic(1e-3, 0.3), 1.0, nu, 0.0}, -none,
                                                 random.uniform(-1, 2), random.uniform(0.3, 0.95)));
    default:  // heavy damping
      return start_anywhere(
          random, steady_scene({random.uniform(0.9, 5), 10.0, nu, 0.0}, -xs / 5, xs / 5, random.uniform(0.1, 0.95)));
  }
}

/// The same scene between soft stops, or a soft and a rigid one, in part without a spring.
point::Problem soft_scene_number(std::uint64_t i) {
  point::Problem scene = scene_number(i);
  support::Random random(18, i);
  Stops& stops = scene.stops;
  const auto any_zeta = [&] { return random.happens(0.2) ? 0 : random.uniform(0.02, 1.5); };
  stops.stiffness_upper = random.logarithmic(1, 1e5), stops.damping_upper = any_zeta();
  if (!std::isfinite(stops.lower) || random.happens(0.2)) return scene;
  stops.stiffness_lower = random.logarithmic(1, 1e5), stops.damping_lower = any_zeta();
  if (i % 9 > 1 && random.happens(0.2)) scene.oscillator.stiffness = random.happens(0.5) ? 0 : -0.3;
  return scene;
}

/// The results in the scalar loop, and in lanes if they accept the scene.
std::vector<point::PointResult> answers_of(const point::Problem& scene) {
  point::ThreadScratch scratch;
  std::vector<point::PointResult> answers{run_point(scene, scratch)};
  const point::WorkItem task{0, 0, scene, effects_of(scene)};
  if (lanes::widest_instruction_set() != lanes::InstructionSet::scalar && lanes::accepts(task))
    answers.push_back(lanes::run_in_lanes(task, 1, lanes::widest_instruction_set(), scratch));
  return answers;
}

/// The result without shortcuts, over a time that is long enough by an estimate of the transient's length.
point::PointResult everything(point::Problem scene, double settling) {
  scene.integration.all_effects = true;
  if (settling < 1e6)
    scene.time.max_periods = std::max(scene.time.max_periods, 400 + static_cast<std::int64_t>(1.2 * settling));
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}

/// Whether two answers are the same motion: their values are compared elsewhere; here a graze in a motion that rests,
/// and forgets it, may multiply an ulp by 1e9.
bool agree(const point::PointResult& a, const point::PointResult& b) {
  if (a.status != b.status) return false;
  if (a.status != steady::Status::periodic) return true;  // chaos has no values to compare
  const double x = 1e-5 * (std::abs(b.x_min) + std::abs(b.x_max)), v = 1e-5 * (std::abs(b.v_min) + std::abs(b.v_max));
  return a.period_ratio == b.period_ratio && std::abs(a.x_min - b.x_min) <= x && std::abs(a.x_max - b.x_max) <= x &&
         std::abs(a.v_min - b.v_min) <= v && std::abs(a.v_max - b.v_max) <= v;
}

/// Whether the scene settles to an answer if its start and force are changed in the last digits (a motion that rests
/// forgets its start). Mostly one of a few such scenes does; nearly elastic scenes have chaotic transients of thousands
/// of periods and several attractors, some of which attract one motion of a hundred. If chaos leads from one rest to
/// the next, the last digits decide the whole motion, and hardly two of these answers agree.
bool agrees_nearby(const point::PointResult& found, const point::Problem& scene) {
  std::vector<point::PointResult> distinct;
  for (std::size_t i = 0; i < 240; ++i) {
    point::Problem near = scene;
    const double number = static_cast<double>(i), angle = number * pi<double>() / 6;
    const double size = (1 + number / 12) * 1e-14 * std::max(1.0, std::abs(near.start.velocity));
    near.start.displacement =
        std::clamp(near.start.displacement + size * std::cos(angle), scene.stops.lower, scene.stops.upper);
    near.start.velocity += size * std::sin(angle);
    near.oscillator.forcing *= 1 + number * 1e-15;
    if (i % 2 == 1) near.time.max_periods *= 5;
    const point::PointResult other = everything(near, found.settling_estimate);
    if (agree(found, other)) return true;
    if (std::ranges::none_of(distinct, [&](const point::PointResult& one) { return agree(one, other); }))
      distinct.push_back(other);
    if (i == 23 && distinct.size() >= 8) return true;
  }
  return false;
}

std::string words(const point::PointResult& r) {
  return "status " + std::to_string(static_cast<int>(r.status)) + ", " + std::to_string(r.period_ratio) +
         " periods, x " + std::to_string(r.x_min) + " ... " + std::to_string(r.x_max) + " after " +
         std::to_string(r.periods);
}

TEST(Attractors, a_transient_that_meets_a_stop_for_the_first_time_after_hundreds_of_periods_is_waited_for) {
  // near nu = 2 and 1/2 the phase of the transient drifts slowly against the force, and a stop cuts a part of its way
  point::Problem even = steady_scene({0.0001, 1.0, 2.001, 0.0}, -0.8, 0.8, 0.7);
  even.start.velocity = -1.2;
  const double xs = 1.4682365128203856;
  point::Problem half =
      steady_scene({0.00023856363337609502, 1.0, 0.5009864428348564, 0.0}, -xs, xs, 0.9190640573262331);
  half.start = {0.10187729959232728, 0.5516070378070669, 0.0};
  half.time.max_periods = 50000;
  for (const point::Problem& scene : {even, half}) {
    for (const point::PointResult& answer : answers_of(scene)) {
      EXPECT_EQ(answer.status, steady::Status::periodic);
      EXPECT_EQ(answer.period_ratio, 1.0);
      EXPECT_EQ(answer.x_max, scene.stops.upper);
      EXPECT_EQ(answer.x_min, scene.stops.lower);
      EXPECT_GT(answer.periods, 60);
    }
  }
}

/// Checks that no answer is another motion than that to which its scene settles.
template <class Draw>
void expect_no_other_motion(const Draw& draw, std::uint64_t count) {
  const auto [from, to] = support::scene_range(count);
  std::size_t periodic = 0, sensitive = 0, by_newton = 0;
  for (std::uint64_t i = from; i < to; ++i) {
    const point::Problem scene = draw(i);
    const std::vector<point::PointResult> answers = answers_of(scene);
    const point::PointResult all = everything(scene, answers[0].settling_estimate);
    periodic += all.status == steady::Status::periodic;
    for (std::size_t k = 0; k < answers.size(); ++k) {
      by_newton += answers[k].found_by == steady::FoundBy::newton;
      if (agree(answers[k], all)) continue;
      const bool nearby = agrees_nearby(answers[k], scene);
      sensitive += nearby;
      EXPECT_TRUE(nearby) << "scene " << i << (k == 0 ? ", scalar: " : ", lanes: ") << words(answers[k])
                          << "; all effects: " << words(all) << " by "
                          << steady::found_by_names[static_cast<std::size_t>(answers[k].found_by)];
    }
  }
  std::cout << to - from << " scenes, " << periodic << " periodic, " << by_newton << " answers by Newton's method, "
            << sensitive << " that 1e-14 of the start decides\n";
  if (to - from < 90) return;
  EXPECT_GT(periodic, (to - from) / 2);
  EXPECT_GT(by_newton, (to - from) / 4);
}

TEST(Attractors, no_shortcut_ends_on_another_motion_than_the_scene) { expect_no_other_motion(scene_number, 100); }

TEST(Attractors, no_shortcut_ends_on_another_motion_between_soft_stops) {
  expect_no_other_motion(soft_scene_number, 90);
}

}  // namespace
}  // namespace clatter::hard::attractors_test
