#include "bench/unit.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

#include "bench/sincos.hpp"

namespace clatter::bench {
namespace {

template <lanes::InstructionSet arch>
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

template <lanes::InstructionSet arch>
void add_sincos() {
  if (is_supported(arch))
    benchmark::RegisterBenchmark(("sincos/" + std::string(name_of(arch))).c_str(), time_sincos<arch>);
}

}  // namespace

std::vector<lanes::InstructionSet> archs_here() {
  std::vector<lanes::InstructionSet> result;
  for (const lanes::InstructionSet arch : {lanes::InstructionSet::scalar, lanes::InstructionSet::sse2,
                                           lanes::InstructionSet::avx2, lanes::InstructionSet::avx512})
    if (is_supported(arch)) result.push_back(arch);
  return result;
}

void add_unit() {
  add_sincos<lanes::InstructionSet::sse2>(), add_sincos<lanes::InstructionSet::avx2>(),
      add_sincos<lanes::InstructionSet::avx512>();
}

int run_benchmarks(int count, char** arguments) {
  add_unit();
  benchmark::AddCustomContext("best", std::string(lanes::name_of(lanes::widest_instruction_set())));
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace clatter::bench
