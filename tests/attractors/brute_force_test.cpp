#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "point/every_effect.hpp"
#include "scene/effects.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/random.hpp"
#include "support/scene_range.hpp"
#include "sweep/figures.hpp"
#include "sweep/run.hpp"

namespace clatter::attractors::brute_force_test {
namespace {

constexpr std::size_t starts = 10;
constexpr int looked_at = 6000;  // forcing periods

/// Any scene of two stops, or one; three in four are symmetric.
point::Problem any_scene(support::Random& random) {
  point::Problem scene;
  scene.oscillator = {random.logarithmic(0.02, 0.3), random.sign(), random.logarithmic(0.3, 3.0), 0.0};
  const double stop = random.logarithmic(0.2, 4.0), R = random.uniform(0.3, 0.95);
  scene.stops = {-stop, stop, R, R};
  if (random.happens(0.25)) {
    scene.oscillator.load = random.uniform(-0.5, 0.5);
    if (random.happens(0.5)) scene.stops.upper = std::numeric_limits<double>::infinity();
  }
  scene.time.max_periods = 2000;
  scene.observe.attractor = true;
  return scene;
}

/// The states of a motion at forcing phase 0 from one of them on, by the scalar loop with every effect.
std::vector<PhasePoint> long_run(const point::Problem& scene, double x, double v) {
  return point::with_every_effect(scene, [&]<Effects E>() {
    stepping::Exact<double, E> integrator(scene);
    motion::State<double> state;
    state.x = x, state.v = v;
    stepping::NoObserver nobody;
    std::vector<PhasePoint> states;
    while (states.size() < looked_at &&
           advance_to_section(integrator, state, state.periods, nobody) == stepping::Outcome::completed)
      states.push_back({state.x, state.v});
    return states;
  });
}

double apart(const PhasePoint& a, const PhasePoint& b) { return std::max(std::abs(a.x - b.x), std::abs(a.v - b.v)); }

double size_of(const std::vector<PhasePoint>& states) {
  double size = 0;
  for (const PhasePoint& s : states) size = std::max({size, std::abs(s.x), std::abs(s.v)});
  return size;
}

/// The period of settled motion, 0 if it has none up to 64.
std::size_t period_of_states(const std::vector<PhasePoint>& states) {
  const double limit = 1e-7 * size_of(states);
  for (std::size_t n = 1; n <= 64; ++n) {
    bool repeats = true;
    for (std::size_t i = 0; repeats && i < 128; ++i) repeats = apart(states[i], states[i + n]) <= limit;
    if (repeats) return n;
  }
  return 0;
}

/// The distance of two clouds of states, 0 ... 1: half the sum of the differences of their shares in 12 x 12 boxes.
double distance_of(const std::vector<PhasePoint>& a, const std::vector<PhasePoint>& b) {
  constexpr int boxes = 12;
  std::vector<PhasePoint> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const auto x = std::ranges::minmax(all, {}, &PhasePoint::x), v = std::ranges::minmax(all, {}, &PhasePoint::v);
  const auto part = [](double value, double from, double to) {
    return std::clamp(static_cast<int>(boxes * (value - from) / (to - from)), 0, boxes - 1);
  };
  std::array<double, std::size_t{boxes} * boxes> shares{};
  const auto add = [&](const std::vector<PhasePoint>& states, double weight) {
    for (const PhasePoint& s : states)
      shares[static_cast<std::size_t>(part(s.x, x.min.x, x.max.x) * boxes + part(s.v, v.min.v, v.max.v))] += weight;
  };
  add(a, 1.0 / static_cast<double>(a.size())), add(b, -1.0 / static_cast<double>(b.size()));
  return std::accumulate(shares.begin(), shares.end(), 0.0, [](double sum, double d) { return sum + std::abs(d); }) / 2;
}

/// Whether two settled motions are the same; nothing if their clouds of states are neither alike nor apart.
std::optional<bool> same(const std::vector<PhasePoint>& a, const std::vector<PhasePoint>& b) {
  const std::size_t n = period_of_states(a);
  if (n != period_of_states(b)) return false;
  if (n == 0) {
    const double distance = distance_of(a, b);
    return distance < 0.35 ? std::optional(true) : distance > 0.65 ? std::optional(false) : std::nullopt;
  }
  return std::ranges::any_of(std::span(b).first(n),
                             [&](const PhasePoint& s) { return apart(s, a[0]) <= 1e-6 * size_of(a); });
}

/// The motions that starts end in, told apart by the numbers, and by running every one for long from the state in which
/// it ended: they make the same groups. Twelve scenes; the longer form is CLATTER_SCENES=0:1000.
TEST(BruteForce, long_runs_from_the_states_in_which_points_ended_make_the_same_groups) {
  const support::SceneRange range = support::scene_range(12);
  std::size_t points = 0, left_out = 0;
  for (std::uint64_t i = range.from; i < range.to; ++i) {
    support::Random random(22, i);
    const point::Problem scene = any_scene(random);
    sweep::Axis x0{Parameter("x0"), {}}, v0{Parameter("v0"), {}};
    const double widest = std::isfinite(scene.stops.upper) ? scene.stops.upper : -scene.stops.lower;
    for (std::size_t k = 0; k < starts; ++k) {
      x0.values.push_back(random.uniform(scene.stops.lower, widest));
      v0.values.push_back(random.uniform(-2, 2) * widest);
    }
    const sweep::Sweep sweep{.problem = scene, .dimensions = {{x0, v0}}};
    const results::Dataset dataset = run(sweep, {.threads = 1, .arch = lanes::InstructionSet::scalar}).dataset;
    const auto& number = std::get<std::vector<std::int32_t>>(results::find(dataset, "attractor")->values);
    const auto& periods = std::get<std::vector<std::int64_t>>(results::find(dataset, "motion_period_ratio")->values);
    std::vector<std::vector<PhasePoint>> ends;
    std::vector<char> known(starts, 0);
    for (std::size_t k = 0; k < starts; ++k) {
      point::ThreadScratch scratch;
      const point::PointResult ended = run_point(problem_at(sweep, k), scratch);
      ends.push_back(long_run(scene, ended.attractor_x, ended.attractor_v));
      // a transient that outlasts the search ends in a motion by rounding, in each program in another one
      const bool lasts = number[k] != undecided && ended.attractor_periods == 0 &&
                         (periods[static_cast<std::size_t>(number[k])] > 0 || period_of_states(ends[k]) > 0);
      known[k] = number[k] != undecided && !lasts ? 1 : 0;
      ++points, left_out += known[k] == 0 ? 1 : 0;
    }
    for (std::size_t a = 0; a < starts; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if (known[a] == 0 || known[b] == 0) continue;
        const auto expected = same(ends[a], ends[b]);
        if (expected) {
          EXPECT_EQ(number[a] == number[b], *expected)
              << "scene " << i << ", starts " << b << " and " << a << ": motions " << number[b] << " and " << number[a]
              << ", periods " << period_of_states(ends[b]) << " and " << period_of_states(ends[a]);
        }
      }
  }
  RecordProperty("points", static_cast<int>(points)), RecordProperty("left_out", static_cast<int>(left_out));
  EXPECT_LE(static_cast<double>(left_out), 0.02 * static_cast<double>(points));
}

}  // namespace
}  // namespace clatter::attractors::brute_force_test
