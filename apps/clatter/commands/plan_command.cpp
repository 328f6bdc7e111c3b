#include <iostream>

#include "commands/commands.hpp"
#include "runs/plan_report.hpp"
#include "runs/room_check.hpp"
#include "runs/trial_run.hpp"
#include "sweep/run.hpp"
#include "tables/json_output.hpp"
#include "terminal/common_options.hpp"
#include "terminal/warnings.hpp"

namespace clatter::app {
namespace {

int print_plan(const Arguments& arguments) {
  const int threads = sweep::threads_used({.threads = threads_of(arguments)});
  const lanes::InstructionSet arch = arch_of(arguments);
  const std::optional<results::Shard> shard = shard_of(arguments);
  const config::Config config = config_of(arguments);
  const plan::MemoryNeed need = check_memory(config, shard, threads);
  check_disk(config, need, arguments.operands[0] == "-" ? "clatter.h5" : output_of(arguments, ".h5"));
  const sweep::RunOptions options{.threads = threads, .arch = arch};
  plan::Plan plan = plan::plan_of(config.sweep, options, need, shard);
  const std::optional<double> seconds = foretold_seconds(config, options, shard, need);
  if (arguments.has("json")) {
    join_warnings(plan, config);
    std::cout << plan_json(plan, config.sweep, threads, seconds);
  } else {
    std::cout << plan_text(plan, config.sweep, threads, seconds) << std::flush;
    say_notes(config), warn(config), warn(plan);
  }
  return done;
}

constexpr std::string_view plan_examples =
    "  clatter plan configs/fig22.toml\n"
    "  clatter plan configs/fig22.toml --json --set scene.xs=-6\n"
    "  clatter plan configs/map_nu_xs.toml --shard 0/4     a quarter of its points\n";

}  // namespace

Command plan_command() {
  return {.name = "plan",
          .usage = "plan CONFIG [OPTION]...",
          .summary = "show the work of a run before it starts: effects and why, time, memory, output",
          .examples = plan_examples,
          .operands = {"CONFIG"},
          .required_operands = 1,
          .options = {{"json", 0, "", "print JSON, including warnings"},
                      set_option,
                      ini_option,
                      threads_option,
                      arch_option,
                      {"shard", 0, "K/N", "plan only points K, K + N, ... (K from 0), as for `clatter run --shard`"},
                      {"help", 'h', "", "print this help"}},
          .run = print_plan};
}

}  // namespace clatter::app
