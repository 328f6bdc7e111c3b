#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "commands.hpp"
#include "io/config.hpp"
#include "io/figure_file.hpp"
#include "io/publish.hpp"
#include "io/suggestion.hpp"
#include "progress.hpp"
#include "run_report.hpp"
#include "sweep/memory.hpp"

namespace clatter {
namespace {

std::vector<Override> overrides_of(const Arguments& arguments) {
  std::vector<Override> overrides;
  for (const std::string& word : arguments.values("set")) {
    const std::size_t sign = word.find('=');
    if (sign == std::string::npos || word.find_first_not_of(" \t") == sign) {
      throw UsageError("--set " + in_quotes(word) + " is no KEY=VALUE; write e.g. --set scene.R=0.5");
    }
    overrides.push_back({word.substr(0, sign), word.substr(sign + 1)});
  }
  return overrides;
}

int threads_of(const Arguments& arguments) {
  const std::optional<std::string> word = arguments.value("threads");
  if (!word) return 0;
  int threads = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), threads);
  if (error != std::errc{} || end != word->data() + word->size() || threads < 1 || threads > 1024) {
    throw UsageError("--threads " + in_quotes(*word) + "; permitted: a whole number from 1 to 1024");
  }
  return threads;
}

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

std::string gibibytes(double bytes) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g GiB", bytes / (1 << 30));
  return text.data();
}

/// Results and the file's image of them are in memory together at the end of a run, which is too late to find out.
void check_memory(const Sweep& sweep) {
  const double needed = 2 * result_bytes(sweep);
  const double there = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (there <= 0 || needed <= there) return;
  throw UsageError("the results of " + std::to_string(size(sweep)) + " points and the file's image of them take " +
                   gibibytes(needed) + ", this machine has " + gibibytes(there) +
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
  const int threads = threads_of(arguments);
  const bool shown = progress_wanted(arguments);
  const std::string output = output_of(arguments);
  const Config config = read_config(arguments.operands[0], overrides_of(arguments));
  check_not_config(arguments.operands[0], output);
  check_writable(output);
  check_memory(config.sweep);
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
                  {"set", 0, "KEY=VALUE", "a value in place of the configuration's, e.g. scene.R=0.5; repeatable",
                   true},
                  {"threads", 0, "N", "threads, 1 to 1024; default: as many as the machine offers"},
                  {"progress", 0, "WHEN", "auto (on a terminal), always, never"},
                  {"quiet", 'q', "", "print errors only"},
                  {"verbose", 'v', "", "print threads, impacts, host, times too"},
                  {"help", 'h', "", "print this help"}},
      .run = run_config};
}

}  // namespace clatter
