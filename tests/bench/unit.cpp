#include "bench/unit.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

#include "bench/sincos.hpp"

namespace clatter::bench {
namespace {

template <Arch arch>
void time_sincos(benchmark::State& state) {
  Sines of;
  for (std::size_t i = 0; i < Sines::count; ++i) of.angles[i] = -3 + 6 * static_cast<double>(i) / (Sines::count - 1);
  for ([[maybe_unused]] auto _ : state) {
    sincos<arch>(of);
    benchmark::DoNotOptimize(of);
    benchmark::ClobberMemory();
  }
  using benchmark::Counter;
  state.counters["time"] = Counter(Sines::count, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

template <Arch arch>
void add_sincos() {
  if (runs_here(arch))
    benchmark::RegisterBenchmark(("sincos/" + std::string(name_of(arch))).c_str(), time_sincos<arch>);
}

}  // namespace

std::vector<Arch> archs_here() {
  std::vector<Arch> result;
  for (const Arch arch : {Arch::scalar, Arch::sse2, Arch::avx2, Arch::avx512})
    if (runs_here(arch)) result.push_back(arch);
  return result;
}

void add_unit() { add_sincos<Arch::sse2>(), add_sincos<Arch::avx2>(), add_sincos<Arch::avx512>(); }

int run_benchmarks(int count, char** arguments) {
  add_unit();
  benchmark::AddCustomContext("best", std::string(name_of(best_arch())));
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace clatter::bench
