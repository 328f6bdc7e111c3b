// Time per impact near Fig. 18, with two in every forcing period, and per forcing period of the sweep of Fig. 23 and of
// its part in which impacts never end, for each instruction set on one thread; and for both the numbers of lanes times
// steps to be proved free of contact, and of lanes times contacts to be refined, idle lanes included.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/sweeps.hpp"
#include "bench/unit.hpp"

namespace clatter::bench {
namespace {

constexpr double periods = 300;  // of each point, on average

void time_sweep(benchmark::State& state, const sweep::Sweep& sweep, lanes::InstructionSet arch) {
  using benchmark::Counter;
  Work work;
  sweep::LaneWork lanes;
  for ([[maybe_unused]] auto _ : state) {
    const sweep::RunResult result = run(sweep, {.threads = 1, .arch = arch});
    work = work_of(result), lanes = result.lanes;
  }
  const auto per = Counter::kIsIterationInvariantRate | Counter::kInvert;
  state.counters["impact"] = Counter(work.impacts, per);
  state.counters["period"] = Counter(work.periods, per);
  state.counters["proved_impact"] = lanes.proved / work.impacts;
  state.counters["refined_impact"] = lanes.refined / work.impacts;
  state.counters["proved_period"] = lanes.proved / work.periods;
  state.counters["refined_period"] = lanes.refined / work.periods;
}

void add(const std::string& name, const sweep::Sweep& sweep) {
  for (const lanes::InstructionSet arch : archs_here())
    benchmark::RegisterBenchmark((name + '/' + std::string(name_of(arch))).c_str(), [=](benchmark::State& state) {
      time_sweep(state, sweep, arch);
    })->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace clatter::bench

int main(int count, char** arguments) {
  using namespace clatter::bench;
  add("fig18", transients(xs_18, 200, periods));
  add("fig18_1000", transients(xs_18, 1000, periods));
  add("fig23", transients(xs_23, 200, periods));
  add("fig23_hitting", transients_that_keep_hitting(200, periods));
  return run_benchmarks(count, arguments);
}
