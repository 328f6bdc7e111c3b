#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <iostream>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "checkpointer.hpp"
#include "commands.hpp"
#include "common_options.hpp"
#include "config/config.hpp"
#include "config/suggestion.hpp"
#include "memory_check.hpp"
#include "plan_report.hpp"
#include "progress.hpp"
#include "results/dataset_file.hpp"
#include "results/output_place.hpp"
#include "results/version.hpp"
#include "run_report.hpp"
#include "storage/error.hpp"
#include "storage/journal.hpp"
#include "storage/utf8.hpp"
#include "sweep/rounding_fingerprint.hpp"
#include "warnings.hpp"

namespace clatter::app {
namespace {

/// What -o names; else the configuration's name with .h5, for a shard with .K-of-N.h5.
std::string output_of(const Arguments& arguments, const std::optional<sweep::Shard>& shard) {
  if (!shard) return output_of(arguments, ".h5");
  return output_of(arguments, '.' + std::to_string(shard->number) + "-of-" + std::to_string(shard->of) + ".h5");
}

storage::Journal::Begin begin_of(const Arguments& arguments) {
  if (arguments.has("resume") && arguments.has("restart"))
    throw UsageError("--resume beside --restart; give one of them");
  if (arguments.has("restart")) return storage::Journal::Begin::restart;
  return arguments.has("resume") ? storage::Journal::Begin::resume : storage::Journal::Begin::anyhow;
}

/// When --max-time is over, counted from now.
std::optional<Checkpointer::Clock::time_point> end_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("max-time");
  if (!word) return std::nullopt;
  double seconds = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), seconds);
  if (error != std::errc{} || end != word->data() + word->size() || !(seconds > 0) || seconds > 1e9)
    throw UsageError("--max-time " + config::in_quotes(*word) + "; permitted: a number of seconds above 0, up to 1e9");
  return Checkpointer::Clock::now() +
         std::chrono::duration_cast<Checkpointer::Clock::duration>(std::chrono::duration<double>(seconds));
}

storage::JournalKey key_of(const config::Config& config, lanes::InstructionSet arch,
                           const std::optional<sweep::Shard>& shard) {
  return {.config = config.text,
          .program = std::string(results::version())
                         .append(" ")
                         .append(results::git_commit())
                         .append(", ")
                         .append(results::compiler()),
          .rounding = sweep::rounding_fingerprint(config.sweep, arch),
          .shard = shard ? text_of(*shard) : ""};
}

void say_plan(const config::Config& config, int threads, const std::optional<sweep::Shard>& shard) {
  plan::Plan plan = plan::plan_of(config.sweep, threads, shard);
  plan.need = with_configuration(plan.need, config);
  std::cerr << plan_text(plan, config.sweep, threads);
  say_notes(config), warn(plan);
}

void run_points(sweep::SweepRun& sweep, sweep::RunOptions options, bool shown) {
  Progress progress(shown, "points", static_cast<double>(sweep.restored_points()));
  if (shown)
    options.progress = [&](double finished, std::size_t total) { progress.show(finished, static_cast<double>(total)); };
  sweep.run(options);
}

void say_beginning(const storage::Journal& journal, const sweep::SweepRun& sweep, const std::string& output,
                   bool quiet) {
  if (!journal.is_locked())
    std::cerr << "there are no locks here: see that no other run writes " << storage::quoted_name(output)
              << " meanwhile\n";
  if (sweep.restored_points() > 0 && !quiet)
    std::cerr << "goes on from " << sweep.restored_points() << " finished points\n";
}

/// Does the work of a run. If that fails, the keeper saves what it can, and the error says what the next run will find.
template <typename Work>
void keeping(std::optional<Checkpointer>& checkpointer, storage::Journal& journal, Work work) {
  const auto failed = [&](const storage::IoError& error) {
    checkpointer.reset();
    return storage::IoError(error.what() + (journal.had_records() ? "\nclatter: " + journal.leave() : ""));
  };
  try {
    work();
  } catch (const storage::IoError& error) {
    throw failed(error);
  } catch (const std::bad_alloc&) {
    throw failed(storage::no_memory("it ran out"));
  }
}

int run_config(const Arguments& arguments) {
  if (arguments.has("quiet") && arguments.has("verbose"))
    throw UsageError("--quiet beside --verbose; give one of them");
  std::signal(SIGPIPE, SIG_IGN);  // that nobody is left to read what is said on stderr is no reason to end
  const std::string began = now();
  const std::optional<Checkpointer::Clock::time_point> end = end_of(arguments);
  const lanes::InstructionSet arch = arch_of(arguments);
  const int threads = sweep::threads_used({.threads = threads_of(arguments)});
  const bool shown = progress_wanted(arguments);
  const storage::Journal::Begin begin = begin_of(arguments);
  const std::optional<sweep::Shard> shard = shard_of(arguments);
  const std::string output = output_of(arguments, shard);
  const config::Config config = config_of(arguments);
  check_not_config(arguments.operands[0], output);
  const results::OutputPlace place(output, {.shard = shard ? text_of(*shard) : "", .title = config.title},
                                   arguments.has("force"));
  check_memory(config, shard, threads);
  if (arguments.has("verbose")) say_plan(config, threads, shard);
  if (!arguments.has("quiet")) warn(config);
  if (!arguments.has("quiet") && !arguments.has("verbose")) warn_of_dearest_point(config.sweep, shard);

  sweep::SweepRun sweep(config.sweep, shard);
  const storage::RecordLimit limit{sweep.most_saved(), config.sweep.scene.observe.impact_log};
  storage::Journal journal(output, key_of(config, arch, shard), limit, begin, [&](std::span<const std::byte> results) {
    if (!sweep.restore(results))
      throw storage::IoError("the journal of " + storage::quoted_name(output) +
                             " doesn't fit the sweep; --restart begins anew");
  });
  say_beginning(journal, sweep, output, arguments.has("quiet"));

  const auto save = [&] {
    sweep.save([&](std::span<const std::byte> results) { journal.append(results); });
    journal.sync();
  };
  sweep::RunResult result;
  std::string summary;
  std::optional<Checkpointer> checkpointer;
  keeping(checkpointer, journal, [&] {
    checkpointer.emplace(journal, save, end);
    run_points(sweep, {.threads = threads, .arch = arch}, shown);
    checkpointer->finish();
    result = sweep.result();
    summary = summary_line(result, config.sweep, shard, output);
    const auto image = shard ? results::image_with_checksum : results::file_image;
    place.write_atomically(image(std::move(result.dataset), config).bytes,
                           [&](std::uint64_t bytes) { journal.give_back(bytes); });
  });
  journal.remove();
  if (!arguments.has("quiet")) std::cerr << summary << '\n';
  if (arguments.has("verbose")) std::cerr << details(result, command_line(), began);
  return result.failed_points > 0 ? points_failed : done;
}

constexpr std::string_view examples =
    "  clatter run configs/fig22.toml\n"
    "  clatter run configs/fig22.toml -o coarse.h5 \\\n"
    "    --set sweep.nu='linspace(0.5, 1.5, 51)' --set scene.R=0.5\n"
    "  clatter run configs/fig22.ini --threads 2 --progress never\n"
    "  sed s/0.7/0.5/ configs/fig22.toml | clatter run - -o other.h5\n"
    "  clatter run configs/map_nu_xs.toml --shard 0/4      writes map_nu_xs.0-of-4.h5\n";

}  // namespace

Command run_command() {
  return {
      .name = "run",
      .usage = "run CONFIG [OPTION]...",
      .summary = "run a configuration and write its results as HDF5",
      .examples = examples,
      .operands = {"CONFIG"},
      .required_operands = 1,
      .options = {output_option,
                  force_option,
                  set_option,
                  ini_option,
                  threads_option,
                  arch_option,
                  {"shard", 0, "K/N", "compute points K, K + N, ... alone, K from 0; `clatter merge` joins the files"},
                  {"resume", 0, "", "go on from an interrupted run, as without it; an error where there is none"},
                  {"restart", 0, "", "begin anew, without what an interrupted run has left"},
                  {"max-time", 0, "SECONDS", "stop after so long, keep what is finished, and exit with 124"},
                  progress_option,
                  {"quiet", 'q', "", "print errors only"},
                  {"verbose", 'v', "", "print the plan before, and after it what was used, host and times"},
                  {"help", 'h', "", "print this help"}},
      .run = run_config};
}

}  // namespace clatter::app
