#include "runs/room_check.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <string>

#include "plan/available_memory.hpp"
#include "storage/error.hpp"
#include "storage/file_writer.hpp"
#include "storage/input_file.hpp"
#include "storage/journal.hpp"
#include "storage/utf8.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

void check(const std::string& what, double needed, double mapped, int threads) {
  const plan::MemoryLimit limit = plan::memory_limit(threads, mapped);
  if (needed > limit.besides(mapped))
    throw storage::no_memory(what + ", " + limit.name + ' ' + bytes_text(limit.bytes));
}

/// Adds the copies of the configuration's text to a run's need; if reading the configuration took more than all that,
/// the need is that peak.
plan::MemoryNeed with_configuration(plan::MemoryNeed need, const config::Config& config) {
  constexpr double copies = 4;  // in Config, in the journal's key, in the file and on its way there
  need.memory = std::max(need.memory + copies * static_cast<double>(config.text.size()), plan::peak_bytes());
  return need;
}

std::string points_text(const config::Config& config, const std::optional<results::Shard>& shard) {
  return counted(static_cast<double>(sweep::Share(config.sweep, shard).points()), "point") + " take ";
}

/// Bytes of a file on its disk; none if there is no such file.
std::uint64_t stored_at(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? storage::stored_bytes(status) : 0;
}

void check_room(const std::string& what, double needed, const std::string& output) {
  const std::string target = storage::target_of(output).string();
  const std::uint64_t room = storage::room_at(target), journal = stored_at(target + storage::journal_ending);
  if (needed <= static_cast<double>(room) + static_cast<double>(journal)) return;
  throw storage::IoError(
      "not enough disk space: " + what + bytes_text(needed) + " beside " + storage::quoted_name(output) + ", " +
      bytes_text(static_cast<double>(room)) +
      " are free there; free some space, name a place that has more, observe less, or sweep fewer points");
}

}  // namespace

plan::MemoryNeed check_memory(const config::Config& config, const std::optional<results::Shard>& shard, int threads) {
  const plan::MemoryNeed need = with_configuration(plan::memory_need(config.sweep, shard, threads), config);
  std::string what = points_text(config, shard) + bytes_text(need.memory);
  if (need.log > 0) what += " with an impact log of some " + bytes_text(need.log);
  if (need.in_files > 0) what += " and map files of " + bytes_text(need.in_files);
  check(what, need.memory, need.in_files, threads);
  return need;
}

void check_disk(const config::Config& config, const plan::MemoryNeed& need, const std::string& output) {
  const double written = config.compression > 0 ? 0.0 : need.output - need.logged;
  check_room("the results take ", written + (need.logged > 0 ? 0.0 : need.in_files), output);
}

void check_merge(const outputs::ShardSet& shards, const std::string& output) {
  check("merging takes " + bytes_text(shards.bytes), shards.bytes, 0, 0);
  if (shards.config.compression == 0) check_room("the merged file takes ", shards.output_bytes, output);
}

}  // namespace clatter::app
