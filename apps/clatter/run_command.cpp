#include <filesystem>
#include <iostream>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "format.hpp"
#include "io/config.hpp"
#include "io/figure_file.hpp"
#include "io/publish.hpp"
#include "io/suggestion.hpp"
#include "plan_report.hpp"
#include "progress.hpp"
#include "run_report.hpp"
#include "sweep/memory.hpp"

namespace clatter {
namespace {

bool progress_wanted(const Arguments& arguments) {
  const std::string when = arguments.value("progress").value_or("auto");
  if (when == "always" || when == "never") return when == "always";
  if (when == "auto") return stderr_is_terminal() && !arguments.has("quiet");
  throw UsageError("--progress " + in_quotes(when) + "; permitted: auto, always, never");
}

std::string output_of(const Arguments& arguments) {
  const std::filesystem::path config(arguments.operands[0]);
  return arguments.value("output").value_or(config.stem().string() + ".h5");
}

/// The results must not take the place of the configuration.
void check_not_config(const std::string& config, const std::string& output) {
  std::error_code error;
  if (!std::filesystem::equivalent(config, output, error)) return;
  throw UsageError("the output " + in_quotes(output) + " is the configuration itself; name another file with -o");
}

/// Too late to find out at the end of a run.
void check_memory(const Sweep& sweep) {
  const double needed = run_bytes(sweep), there = machine_bytes();
  if (there == 0 || needed <= there) return;
  throw UsageError("the results of " + std::to_string(size(sweep)) + " points and the file's image of them take " +
                   bytes_text(needed) + ", this machine has " + bytes_text(there) +
                   "; sweep fewer points, or observe fewer samples and harmonics");
}

RunResult run_with_progress(const Sweep& sweep, int threads, bool shown) {
  const Progress progress(shown);
  RunOptions options{threads, {}};
  if (shown) options.progress = [&](std::size_t finished, std::size_t total) { progress.show(finished, total); };
  return run(sweep, options);
}

int run_config(const Arguments& arguments) {
  if (arguments.has("quiet") && arguments.has("verbose"))
    throw UsageError("--quiet beside --verbose; give one of them");
  const std::string began = now();
  const int threads = threads_used({.threads = threads_of(arguments)});
  const bool shown = progress_wanted(arguments);
  const std::string output = output_of(arguments);
  const Config config = config_of(arguments);
  check_not_config(arguments.operands[0], output);
  check_writable(output);
  check_memory(config.sweep);
  if (arguments.has("verbose")) std::cerr << plan_text(plan_of(config.sweep, threads), config.sweep, threads);
  const RunResult result = run_with_progress(config.sweep, threads, shown);
  publish(output, file_image(result.figure, config));
  if (!arguments.has("quiet")) std::cerr << summary_line(result, output) << '\n';
  if (arguments.has("verbose")) std::cerr << details(result, command_line(), began);
  return result.failed_points > 0 ? points_failed : done;
}

constexpr std::string_view examples =
    "  clatter run configs/fig22.toml\n"
    "  clatter run configs/fig22.toml -o coarse.h5 --set sweep.nu='linspace(0.5, 1.5, 51)' --set scene.R=0.5\n"
    "  clatter run configs/fig22.ini --threads 2 --progress never\n";

}  // namespace

Command run_command() {
  return {
      .name = "run",
      .usage = "run CONFIG [OPTION]...",
      .summary = "run a configuration and write its results as HDF5",
      .examples = examples,
      .operands = {"CONFIG"},
      .required_operands = 1,
      .options = {{"output", 'o', "FILE.h5", "where the results go; default: the configuration's name with .h5, here"},
                  set_option,
                  threads_option,
                  {"progress", 0, "WHEN", "auto (on a terminal), always, never"},
                  {"quiet", 'q', "", "print errors only"},
                  {"verbose", 'v', "", "print the plan before, and after it what was used, host and times"},
                  {"help", 'h', "", "print this help"}},
      .run = run_config};
}

}  // namespace clatter
