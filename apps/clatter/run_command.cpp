#include <algorithm>
#include <iostream>
#include <utility>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "format.hpp"
#include "io/config.hpp"
#include "io/figure_file.hpp"
#include "io/publish.hpp"
#include "plan_report.hpp"
#include "progress.hpp"
#include "run_report.hpp"
#include "sweep/memory.hpp"

namespace clatter {
namespace {

/// Too late to find out at the end of a run.
void check_memory(const Sweep& sweep) {
  const double needed = run_bytes(sweep), there = machine_bytes();
  if (there == 0 || needed <= there) return;
  throw UsageError("the results of " + std::to_string(size(sweep)) +
                   " points, and the largest variable of them once more, take " + bytes_text(needed) +
                   ", this machine has " + bytes_text(there) +
                   "; sweep fewer points, or observe fewer samples and harmonics");
}

RunResult run_with_progress(const Sweep& sweep, int threads, Arch arch, bool shown) {
  const Progress progress(shown);
  RunOptions options{.threads = threads, .arch = arch};
  if (shown) options.progress = [&](std::size_t finished, std::size_t total) { progress.show(finished, total); };
  return run(sweep, options);
}

int run_config(const Arguments& arguments) {
  if (arguments.has("quiet") && arguments.has("verbose"))
    throw UsageError("--quiet beside --verbose; give one of them");
  const std::string began = now();
  const Arch arch = arch_of(arguments);
  const int threads = threads_used({.threads = threads_of(arguments)});
  const bool shown = progress_wanted(arguments);
  const std::string output = output_of(arguments);
  const Config config = config_of(arguments);
  check_not_config(arguments.operands[0], output);
  check_writable(output);
  check_memory(config.sweep);
  if (arguments.has("verbose")) std::cerr << plan_text(plan_of(config.sweep, threads), config.sweep, threads);
  RunResult result = run_with_progress(config.sweep, threads, arch, shown);
  const std::string summary = summary_line(result, output);
  publish(output, file_image(std::move(result.figure), config).bytes);
  if (!arguments.has("quiet")) std::cerr << summary << '\n';
  if (arguments.has("verbose")) std::cerr << details(result, command_line(), began);
  return result.failed_points > 0 ? points_failed : done;
}

constexpr std::string_view examples =
    "  clatter run configs/fig22.toml\n"
    "  clatter run configs/fig22.toml -o coarse.h5 --set sweep.nu='linspace(0.5, 1.5, 51)' --set scene.R=0.5\n"
    "  clatter run configs/fig22.ini --threads 2 --progress never\n";

}  // namespace

Command run_command() {
  return {.name = "run",
          .usage = "run CONFIG [OPTION]...",
          .summary = "run a configuration and write its results as HDF5",
          .examples = examples,
          .operands = {"CONFIG"},
          .required_operands = 1,
          .options = {output_option,
                      set_option,
                      threads_option,
                      arch_option,
                      progress_option,
                      {"quiet", 'q', "", "print errors only"},
                      {"verbose", 'v', "", "print the plan before, and after it what was used, host and times"},
                      {"help", 'h', "", "print this help"}},
          .run = run_config};
}

}  // namespace clatter
