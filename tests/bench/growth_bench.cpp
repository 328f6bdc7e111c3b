// Growth of the time of a run with the number of points and of forcing periods, on one thread, the time of points whose
// stops are out of reach, and the reduction by two threads; all on the widest instruction set of this machine.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <initializer_list>
#include <string>

#include "bench/sweeps.hpp"
#include "bench/unit.hpp"

namespace clatter::bench {
namespace {

/// Runs a sweep; the counter `time` is the time over `parts`: for one thread processor time, else wall time.
benchmark::internal::Benchmark* add(const std::string& name, const sweep::Sweep& sweep, double parts, int threads = 1) {
  using benchmark::Counter;
  const auto time = [=](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(run(sweep, {.threads = threads}));
    state.counters["time"] = Counter(parts, Counter::kIsIterationInvariantRate | Counter::kInvert);
  };
  return benchmark::RegisterBenchmark(name.c_str(), time)->Unit(benchmark::kMillisecond);
}

void add_points() {
  for (const std::size_t points : std::initializer_list<std::size_t>{1'000, 10'000, 100'000, 1'000'000})
    add("points/" + std::to_string(points), transients(xs_18, points, 3), static_cast<double>(points));
}

void add_periods() {
  constexpr std::size_t points = 200;
  for (const int periods : {10, 100, 1'000, 10'000})
    add("periods/" + std::to_string(periods), transients(xs_23, points, periods),
        static_cast<double>(points) * periods);
}

void add_out_of_reach() {
  constexpr std::size_t n = 100;
  add("out of reach/" + std::to_string(n * n), map_out_of_reach(n), static_cast<double>(n * n));
}

/// Equal work for every point, and a map with slow points in it; in wall time.
void add_threads() {
  for (const int threads : {1, 2}) {
    const std::string number = '/' + std::to_string(threads);
    add("threads of transients" + number, transients(xs_18, 10'000, 30), 10'000, threads)->UseRealTime();
    add("threads of the map" + number, map(100), 10'000, threads)->UseRealTime();
  }
}

}  // namespace
}  // namespace clatter::bench

int main(int count, char** arguments) {
  using namespace clatter::bench;
  add_points();
  add_periods();
  add_out_of_reach();
  add_threads();
  return run_benchmarks(count, arguments);
}
