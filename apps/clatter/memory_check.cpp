#include "memory_check.hpp"

#include <algorithm>
#include <string>

#include "format.hpp"
#include "plan/available_memory.hpp"
#include "storage/error.hpp"

namespace clatter::app {
namespace {

void check(const std::string& what, double needed, int threads) {
  const plan::MemoryLimit limit = plan::memory_limit(threads);
  if (needed > limit.bytes) throw storage::no_memory(what + ", " + limit.name + ' ' + bytes_text(limit.bytes));
}

/// Adds the copies of the configuration's text to a run's need; if reading the configuration took more than all that,
/// the need is that peak.
plan::MemoryNeed with_configuration(plan::MemoryNeed need, const config::Config& config) {
  constexpr double copies = 4;  // in Config, in the journal's key, in the file and on its way there
  need.memory = std::max(need.memory + copies * static_cast<double>(config.text.size()), plan::peak_bytes());
  return need;
}

}  // namespace

plan::MemoryNeed check_memory(const config::Config& config, const std::optional<results::Shard>& shard, int threads) {
  const plan::MemoryNeed need = with_configuration(plan::memory_need(config.sweep, shard, threads), config);
  std::string what = counted(static_cast<double>(sweep::Share(config.sweep, shard).points()), "point") + " take " +
                     bytes_text(need.memory);
  if (need.log > 0) what += " with an impact log of some " + bytes_text(need.log);
  check(what, need.memory, threads);
  return need;
}

void check_merge_memory(double bytes) { check("merging takes " + bytes_text(bytes), bytes, 0); }

}  // namespace clatter::app
