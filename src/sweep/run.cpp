#include "sweep/run.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "sweep/parallel.hpp"
#include "sweep/rounding_fingerprint.hpp"
#include "sweep/thread_stacks.hpp"
#include "sweep/worker_pool.hpp"

namespace clatter::sweep {
namespace {

/// Size of packed results from which on they are written at once.
constexpr std::size_t enough_to_save = 256UL * 1024;  // bytes

}  // namespace

int threads_used(const RunOptions& options) { return options.threads > 0 ? options.threads : default_threads(); }

/// Lanes take the exact method's shortcuts to steady motion.
bool runs_in_lanes(const Sweep& sweep, lanes::InstructionSet arch) {
  const stepping::Integration& integration = sweep.problem.integration;
  return arch != lanes::InstructionSet::scalar && integration.method == stepping::Method::exact &&
         integration.shortcuts && !integration.all_effects;
}

std::string_view instruction_set_name(const Sweep& sweep, lanes::InstructionSet arch) {
  return lanes::name_of_bits(runs_in_lanes(sweep, arch) ? arch : lanes::InstructionSet::scalar);
}

SweepRun::SweepRun(const Sweep& sweep, const std::optional<results::Shard>& shard,
                   std::shared_ptr<storage::Scratch> scratch)
    : sweep_(sweep),
      shard_(shard),
      share_(sweep, shard),
      scratch_(std::move(scratch)),
      store_(sweep, shard, scratch_),
      states_(share_.count(), *scratch_) {}

bool SweepRun::restore(std::span<const std::byte> results) {
  while (!results.empty()) {
    std::uint64_t chain = 0;
    if (results.size() < sizeof chain) return false;
    std::memcpy(&chain, results.data(), sizeof chain);
    results = results.subspan(sizeof chain);
    if (chain >= share_.count() || states_.is_finished(chain)) return false;
    for (std::size_t i = 0; i < share_.length(); ++i)
      if (!store_.unpack(share_.local_index(chain, i), results)) return false;
    states_.save(chain), restored_ += share_.length();
  }
  return true;
}

double SweepRun::most_saved() const {
  return enough_to_save + sizeof(std::uint64_t) +
         static_cast<double>(share_.length()) * static_cast<double>(store_.most_packed_without_log());
}

void SweepRun::save(const std::function<void(std::span<const std::byte> results)>& write) {
  std::vector<std::byte> results;
  std::vector<std::size_t> packed;
  const auto write_packed = [&] {
    write(results), results.clear();
    for (const std::size_t chain : packed) states_.save(chain);
    packed.clear();
  };
  states_.each_unsaved([&](std::uint64_t chain) {
    std::size_t more = sizeof chain;
    for (std::size_t i = 0; i < share_.length(); ++i) more += store_.most_packed(share_.local_index(chain, i));
    if (more > enough_to_save)
      results.reserve(results.size() + more);  // growing by doubling would take up to twice as much
    const auto number = std::as_bytes(std::span(&chain, 1));
    results.insert(results.end(), number.begin(), number.end());
    for (std::size_t i = 0; i < share_.length(); ++i) store_.pack(share_.local_index(chain, i), results);
    packed.push_back(chain);
    if (results.size() >= enough_to_save) write_packed();
  });
  if (!results.empty()) write_packed();
}

void SweepRun::run(const RunOptions& options) {
  const auto threads = static_cast<std::size_t>(threads_used(options));
  result_.threads =
      static_cast<int>(std::clamp<std::size_t>(share_.count(), 1, threads));  // more would have nothing to do
  require_thread_stacks(result_.threads);
  WorkerPool pool(sweep_, share_, options, result_.threads, store_, states_, restored_);
  pool.run();
  pool.rethrow();
  store_.number_motions(result_.threads);
  result_.work = pool.work();
  result_.arch = options.arch, result_.lanes = pool.lane_work();
}

RunResult SweepRun::result() {
  result_.points = share_.points();
  result_.statuses = store_.statuses();
  result_.dataset = store_.dataset();
  const std::string bits(instruction_set_name(sweep_, result_.arch));
  result_.dataset.attributes.emplace_back(instruction_set_attribute, bits);
  if (shard_) {
    result_.dataset.attributes.emplace_back("shard", text_of(*shard_));
    result_.dataset.attributes.emplace_back("rounding", rounding_fingerprint(sweep_, result_.arch));
  }
  return std::move(result_);
}

RunResult run(const Sweep& sweep, const RunOptions& options) {
  SweepRun sweep_run(sweep);
  sweep_run.run(options);
  RunResult result = sweep_run.result();
  collect(result.dataset);
  return result;
}

}  // namespace clatter::sweep
