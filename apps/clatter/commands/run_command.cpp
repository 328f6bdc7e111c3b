#include <charconv>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <utility>

#include "commands/commands.hpp"
#include "config/suggestion.hpp"
#include "runs/run_report.hpp"
#include "runs/run_session.hpp"
#include "terminal/common_options.hpp"

namespace clatter::app {
namespace {

/// The file that -o names; else the configuration's name with .h5, for a shard with .K-of-N.h5.
std::string output_of(const Arguments& arguments, const std::optional<results::Shard>& shard) {
  if (!shard) return output_of(arguments, ".h5");
  return output_of(arguments, '.' + std::to_string(shard->number) + "-of-" + std::to_string(shard->of) + ".h5");
}

storage::Journal::Begin begin_of(const Arguments& arguments) {
  if (arguments.has("resume") && arguments.has("restart"))
    throw UsageError("--resume conflicts with --restart; give one of them");
  if (arguments.has("restart")) return storage::Journal::Begin::restart;
  return arguments.has("resume") ? storage::Journal::Begin::resume : storage::Journal::Begin::resume_if_any;
}

/// The end of --max-time, counted from now.
std::optional<Checkpointer::Clock::time_point> end_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("max-time");
  if (!word) return std::nullopt;
  double seconds = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), seconds);
  if (error != std::errc{} || end != word->data() + word->size() || !(seconds > 0) || seconds > 1e9)
    throw UsageError("--max-time " + config::in_quotes(*word) + "; expected a number of seconds above 0, up to 1e9");
  return Checkpointer::Clock::now() +
         std::chrono::duration_cast<Checkpointer::Clock::duration>(std::chrono::duration<double>(seconds));
}

RunRequest request_of(const Arguments& arguments) {
  RunRequest request;
  request.began = now();
  request.end = end_of(arguments);
  request.arch = arch_of(arguments);
  request.threads = sweep::threads_used({.threads = threads_of(arguments)});
  request.progress = progress_kind(arguments);
  request.begin = begin_of(arguments);
  request.shard = shard_of(arguments);
  request.output = output_of(arguments, request.shard);
  request.force = arguments.has("force");
  request.quiet = arguments.has("quiet"), request.verbose = arguments.has("verbose");
  return request;
}

int run_config(const Arguments& arguments) {
  if (arguments.has("quiet") && arguments.has("verbose"))
    throw UsageError("--quiet conflicts with --verbose; give one of them");
  std::signal(SIGPIPE, SIG_IGN);  // a run goes on even if nobody reads its messages any more
  RunRequest request = request_of(arguments);
  config::Config config = config_of(arguments);
  return RunSession(std::move(config), std::move(request)).run();
}

constexpr std::string_view run_examples =
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
      .examples = run_examples,
      .operands = {"CONFIG"},
      .required_operands = 1,
      .options = {output_option,
                  force_option,
                  set_option,
                  ini_option,
                  threads_option,
                  arch_option,
                  {"shard", 0, "K/N", "compute only points K, K + N, ... (K from 0); `clatter merge` joins the files"},
                  {"resume", 0, "", "fail unless there is an interrupted run to continue (continuing is the default)"},
                  {"restart", 0, "", "discard an interrupted run and start over"},
                  {"max-time", 0, "SECONDS", "stop after this time, keep what is finished, and exit with 124"},
                  progress_option,
                  {"quiet", 'q', "", "print only errors"},
                  {"verbose", 'v', "", "print the plan first; work and times afterwards"},
                  {"help", 'h', "", "print this help"}},
      .run = run_config};
}

}  // namespace clatter::app
