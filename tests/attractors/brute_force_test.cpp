#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "model/effects.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/random.hpp"
#include "support/scene_range.hpp"
#include "sweep/figures.hpp"
#include "sweep/run.hpp"

namespace clatter::attractors {
namespace {

using sweep::Parameter;

constexpr std::size_t starts = 10;
constexpr int settling = 4000, looked_at = 3000;  // forcing periods

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

/// The states of a start at forcing phase 0 after it has settled, by the scalar loop with every effect, section by
/// section.
std::vector<PhasePoint> long_run(const point::Problem& scene, double x0, double v0, int skip, int take) {
  return with_any_stops(scene.oscillator, [&]<Effects E>() {
    stepping::Exact<double, E> integrator(scene);
    motion::State<double> state;
    state.x = x0, state.v = v0;
    stepping::NoObserver nobody;
    std::vector<PhasePoint> states;
    for (int i = 0; i < skip + take; ++i) {
      if (advance_to_section(integrator, state, state.periods, nobody) != stepping::Outcome::completed) break;
      if (i >= skip) states.push_back({state.x, state.v});
    }
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

/// The share of states of one motion that another one comes near.
double share_near(const std::vector<PhasePoint>& of, const std::vector<PhasePoint>& to) {
  const double reach = 0.01 * size_of(to);
  const auto near = std::ranges::count_if(std::span(of).first(300), [&](const PhasePoint& s) {
    return std::ranges::any_of(to, [&](const PhasePoint& other) { return apart(s, other) <= reach; });
  });
  return static_cast<double>(near) / 300;
}

/// Whether two settled motions are the same: by their states, compared one by one.
bool same(const std::vector<PhasePoint>& a, const std::vector<PhasePoint>& b) {
  const std::size_t n = period_of_states(a);
  if (n != period_of_states(b)) return false;
  if (n == 0) return share_near(a, b) > 0.8 && share_near(b, a) > 0.8;
  return std::ranges::any_of(std::span(b).first(n),
                             [&](const PhasePoint& s) { return apart(s, a[0]) <= 1e-6 * size_of(a); });
}

/// Twenty scenes; the longer form is CLATTER_SCENES=0:1000. Long transients that are chaotic end in one motion or
/// another by rounding: those starts are followed by both programs for as long, and left out if the second half of the
/// run alone, from its own beginning, still tells them differently.
TEST(BruteForce, long_runs_from_the_same_starts_end_in_the_same_groups) {
  const support::SceneRange range = support::scene_range(20);
  std::size_t points = 0, decided = 0;
  for (std::uint64_t i = range.from; i < range.to; ++i) {
    support::Random random(22, i);
    const point::Problem scene = any_scene(random);
    sweep::Axis x0{Parameter::x0, {}}, v0{Parameter::v0, {}};
    const double widest = std::isfinite(scene.stops.upper) ? scene.stops.upper : -scene.stops.lower;
    for (std::size_t k = 0; k < starts; ++k) {
      x0.values.push_back(random.uniform(scene.stops.lower, widest));
      v0.values.push_back(random.uniform(-2, 2) * widest);
    }
    const sweep::Sweep sweep{.problem = scene, .dimensions = {{x0, v0}}};
    const sweep::Dataset dataset = run(sweep, {.threads = 1}).dataset;
    const auto& number = std::get<std::vector<std::int32_t>>(sweep::find(dataset, "attractor")->values);
    const auto& periods = std::get<std::vector<std::int64_t>>(sweep::find(dataset, "motion_period_ratio")->values);
    std::vector<std::vector<PhasePoint>> ends;
    for (std::size_t k = 0; k < starts; ++k)
      ends.push_back(long_run(scene, x0.values[k], v0.values[k], settling, looked_at));
    std::vector<char> settled(starts, 1);  // a transient that outlasts the search may end in any motion
    for (std::size_t k = 0; k < starts; ++k) {
      ++points;
      if (number[k] == undecided) {
        settled[k] = 0;
        continue;
      }
      const auto found = static_cast<std::size_t>(periods[static_cast<std::size_t>(number[k])]);
      if (found != period_of_states(ends[k])) settled[k] = 0;
      decided += settled[k] != 0 ? 1 : 0;
    }
    for (std::size_t a = 0; a < starts; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if (settled[a] == 0 || settled[b] == 0) continue;
        EXPECT_EQ(number[a] == number[b], same(ends[a], ends[b]))
            << "scene " << i << ", starts " << b << " and " << a << ": motions " << number[b] << " and " << number[a]
            << ", periods " << period_of_states(ends[b]) << " and " << period_of_states(ends[a]);
      }
  }
  EXPECT_GE(static_cast<double>(decided), 0.98 * static_cast<double>(points));
}

}  // namespace
}  // namespace clatter::attractors
