// Scenes with a loose mass by clatter and by Boost.Odeint: time per forcing period on one thread, and the error of the
// state at the end.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/housing.hpp"
#include "bench/unit.hpp"
#include "point/point.hpp"
#include "scene/scene.hpp"

namespace clatter::bench {
namespace {

struct NamedScene {
  const char* name;
  point::Problem scene;
  double periods;
};

NamedScene named(const char* name, const Oscillator& oscillator, const LooseMass& loose, double periods) {
  point::Problem scene;
  scene.oscillator = oscillator, scene.loose = loose;
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = periods * period_of(oscillator);
  return {name, scene, periods};
}

/// Two impacts a period; chatter and a press in each; motion without a period.
std::vector<NamedScene> scenes() {
  const LooseMass light{
      .ratio = 0.02, .lower = -0.4, .upper = 0.4, .restitution_lower = 0.8, .restitution_upper = 0.8, .velocity = 0.3};
  const LooseMass pressed{
      .ratio = 0.5, .lower = -0.1, .upper = 1, .restitution_lower = 0.3, .restitution_upper = 0.3, .load = -0.3};
  return {named("regular", {.damping = 0.005, .forcing = 0.01, .frequency = 1}, light, 300),
          named("presses", {.damping = 0.1, .forcing = 0.4, .frequency = 0.6}, pressed, 300),
          named("chaotic", {.damping = 0.005, .forcing = 0.003, .frequency = 1}, light, 30)};
}

InHousing exact(const point::Problem& scene) {
  point::ThreadScratch scratch;
  const point::PointResult result = run_point(scene, scratch);
  return {{result.end.displacement, result.end.velocity, result.end.loose_place, result.end.loose_velocity},
          result.impacts};
}

template <class Solver>
void time_run(benchmark::State& state, const NamedScene& of, const Solver& solver) {
  using benchmark::Counter;
  InHousing run;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(run = solver(of.scene));
  const InHousing known = exact(of.scene);
  double error = 0.0;
  for (std::size_t i = 0; i < known.state.size(); ++i) error = std::max(error, std::abs(run.state[i] - known.state[i]));
  state.counters["time"] = Counter(of.periods, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["error"] = error / (of.scene.loose.upper - of.scene.loose.lower);
  state.counters["impacts"] = run.impacts / of.periods;
}

void add(const NamedScene& of) {
  const std::string name = std::string(of.name) + ", ";
  benchmark::RegisterBenchmark((name + "clatter/scalar").c_str(),
                               [of](benchmark::State& state) { time_run(state, of, exact); });
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
    char text[32];
    std::snprintf(text, sizeof text, "Odeint/%.0e", tolerance);
    benchmark::RegisterBenchmark((name + text).c_str(), [of, tolerance](benchmark::State& state) {
      time_run(state, of, [tolerance](const point::Problem& scene) { return odeint_in_housing(scene, tolerance); });
    });
  }
}

}  // namespace
}  // namespace clatter::bench

int main(int count, char** arguments) {
  for (const clatter::bench::NamedScene& of : clatter::bench::scenes()) clatter::bench::add(of);
  return clatter::bench::run_benchmarks(count, arguments);
}
