#include <malloc.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "outputs/merge.hpp"
#include "results/dataset_file.hpp"
#include "results/output_place.hpp"
#include "runs/room_check.hpp"
#include "runs/run_report.hpp"
#include "storage/atomic_write.hpp"
#include "storage/journal.hpp"
#include "storage/utf8.hpp"
#include "terminal/common_options.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

void check_not_shard(const std::vector<std::string>& shards, const std::string& output) {
  for (const std::string& path : shards) {
    std::error_code error;
    if (std::filesystem::equivalent(path, output, error))
      throw UsageError("the output " + storage::quoted_name(output) +
                       " is one of the shards; name another file with -o");
  }
}

int merge_shards(const Arguments& arguments) {
  if (arguments.has("quiet") && arguments.has("verbose"))
    throw UsageError("--quiet conflicts with --verbose; give one of them");
  if (!arguments.has("output")) throw UsageError("no output; name it with -o FILE.h5");
  const std::string output = *arguments.value("output");
  check_name(output, FileKind::results);
  storage::check_writable(output);
  check_not_shard(arguments.operands, output);
  storage::require_idle(output);
  const outputs::ShardSet shards = outputs::shard_set(arguments.operands);
  const results::OutputPlace place(output, {.title = shards.config.title}, arguments.has("force"));
  check_merge(shards, output);
  if (arguments.has("verbose"))
    std::cerr << "shards           " << shards.headers.size() << "\nrounding         "
              << storage::printable(shards.headers.front().rounding) << "\nmemory           "
              << bytes_text(shards.bytes) << '\n';
  mallopt(M_MMAP_THRESHOLD, 32 * 1024 * 1024);  // blocks come and go, and anew from the system each would cost a third
  const sweep::StatusTally statuses = outputs::Merge(shards).write(place);
  if (!arguments.has("quiet"))
    std::cerr << counted(static_cast<double>(size(shards.config.sweep)), "point") << " of "
              << counted(static_cast<double>(shards.headers.size()), "shard") << ", "
              << failures_text(statuses, shards.config.sweep) << ", " << storage::printable(output) << '\n';
  return statuses.failed() > 0 ? points_failed : done;
}

constexpr std::string_view merge_examples = "  clatter merge -o map_nu_xs.h5 map_nu_xs.*-of-4.h5\n";

}  // namespace

Command merge_command() {
  return {.name = "merge",
          .usage = "merge -o FILE.h5 SHARD.h5...",
          .summary = "join the files of all shards of a sweep into the file of a single run",
          .examples = merge_examples,
          .operands = {"SHARD.h5"},
          .repeats_last = true,
          .required_operands = 1,
          .options = {{"output", 'o', "FILE.h5", "output file"},
                      force_option,
                      {"quiet", 'q', "", "print only errors"},
                      {"verbose", 'v', "", "print the memory that merging takes and the rounding of the shards"},
                      {"help", 'h', "", "print this help"}},
          .run = merge_shards};
}

}  // namespace clatter::app
