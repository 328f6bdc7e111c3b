// The sweep of Fig. 23 by clatter and by general solvers of differential equations, side by side in one run: time per
// forcing period on one thread, and the number of points at which a solver is wrong at each tolerance.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/reference.hpp"
#include "bench/sweeps.hpp"
#include "bench/unit.hpp"

namespace clatter::bench {
namespace {

constexpr std::size_t points = 200;
constexpr double periods = 300;  // of each point, on average

const sweep::Sweep& sweep() {
  static const sweep::Sweep sweep = transients(xs_23, points, periods);
  return sweep;
}

const Reference& reference() {
  static const Reference reference(sweep());
  return reference;
}

void count_time(benchmark::State& state) {
  using benchmark::Counter;
  state.counters["time"] = Counter(points * periods, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void time_clatter(benchmark::State& state, lanes::InstructionSet arch) {
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(run(sweep(), {.threads = 1, .arch = arch}));
  count_time(state);
}

void time_solver(benchmark::State& state, const Solver& solver) {
  std::vector<Transient> runs(points);
  for ([[maybe_unused]] auto _ : state)
    for (std::size_t i = 0; i < points; ++i) runs[i] = solver(problem_at(sweep(), i));
  const Verdict verdict = reference().judge(solver, runs);
  count_time(state);
  state.counters["wrong"] = static_cast<double>(verdict.wrong);
  state.counters["error"] = verdict.error;
  state.counters["through"] = static_cast<double>(verdict.through);
  state.counters["undetermined"] = static_cast<double>(reference().undetermined());
}

void add_clatter(lanes::InstructionSet arch) {
  const std::string name = "clatter/" + std::string(name_of(arch));
  benchmark::RegisterBenchmark(name.c_str(), [arch](benchmark::State& state) { time_clatter(state, arch); });
}

/// Benchmarks called e.g. "CVODE/1e-08".
template <class Run>
void add_solver(const std::string& name, const Run& transient) {
  for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12}) {
    char text[16];
    std::snprintf(text, sizeof text, "/%.0e", tolerance);
    const Solver solver = [=](const point::Problem& scene) { return transient(scene, tolerance); };
    benchmark::RegisterBenchmark((name + text).c_str(), [=](benchmark::State& state) {
      time_solver(state, solver);
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace clatter::bench

int main(int count, char** arguments) {
  using namespace clatter::bench;
  for (const clatter::lanes::InstructionSet arch : archs_here()) add_clatter(arch);
  add_solver("Odeint",
             [](const auto& scene, double tolerance) { return odeint_transient(scene, tolerance, Looks::ends); });
  add_solver("Odeint with turns",
             [](const auto& scene, double tolerance) { return odeint_transient(scene, tolerance, Looks::turns); });
#ifdef CLATTER_CVODE
  add_solver("CVODE", cvode_transient);
#endif
  return run_benchmarks(count, arguments);
}
