// The 22 figures of the paper in configs/fig02.toml ... fig23.toml, computed one after the other in one
// process on all cores; reading the configurations and writing files is not timed.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "bench/unit.hpp"
#include "config/config.hpp"
#include "sweep/run.hpp"

namespace clatter::bench {
namespace {

std::vector<sweep::Sweep> figures() {
  std::vector<sweep::Sweep> sweeps;
  for (int number = 2; number <= 23; ++number) {
    std::string path(CLATTER_SOURCE "/configs/fig");
    path.append(number < 10 ? "0" : "").append(std::to_string(number)).append(".toml");
    sweeps.push_back(config::read_config(path, {}).sweep);
  }
  return sweeps;
}

void time_figures(benchmark::State& state, const std::vector<sweep::Sweep>& sweeps, lanes::InstructionSet arch) {
  using benchmark::Counter;
  for ([[maybe_unused]] auto _ : state)
    for (const sweep::Sweep& sweep : sweeps) benchmark::DoNotOptimize(run(sweep, {.arch = arch}));
  state.counters["time"] = Counter(1, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

}  // namespace
}  // namespace clatter::bench

int main(int count, char** arguments) {
  using namespace clatter::bench;
  for (const clatter::lanes::InstructionSet arch : archs_here())
    benchmark::RegisterBenchmark(("figures/" + std::string(clatter::lanes::name_of(arch))).c_str(),
                                 [arch, sweeps = figures()](auto& state) { time_figures(state, sweeps, arch); })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  return run_benchmarks(count, arguments);
}
