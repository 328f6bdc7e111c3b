#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terminal/command_line.hpp"

namespace clatter::app {

/// Exit codes; scripts depend on these numbers.
enum ExitCode : int {
  done = 0,
  points_failed = 1,
  usage_error = 2,
  internal_error = 70,
  io_error = 74,
  busy = 75,
  timed_out = 124  ///< a signal gives 128 + its number
};

/// Exit codes and what they tell, e.g. "129" and "stopped by SIGHUP".
struct ExitMeaning {
  std::string_view code, meaning;
};

[[nodiscard]] std::span<const ExitMeaning> exit_meanings();

/// A subcommand: its operands and options, its help, and its function.
struct Command {
  std::string_view name;
  std::string_view usage;                  ///< "run CONFIG [OPTION]..."
  std::string_view summary;                ///< one line for the list of commands
  std::string_view examples;               ///< end its help
  std::string_view notes{};                ///< that its options don't tell; empty: none
  std::vector<std::string_view> operands;  ///< names of its positional arguments, e.g. "CONFIG"
  bool repeats_last = false;               ///< the last operand may be given several times
  std::size_t required_operands = 0;
  std::vector<Option> options;
  int (*run)(const Arguments& arguments);
};

/// Every subcommand, in the order of the help.
[[nodiscard]] std::span<const Command> commands();

/// Throws UsageError if no command has that name.
[[nodiscard]] const Command& find_command(std::string_view name);

[[nodiscard]] Command run_command();
[[nodiscard]] Command plan_command();
[[nodiscard]] Command accuracy_command();
[[nodiscard]] Command branch_command();
[[nodiscard]] Command merge_command();
[[nodiscard]] Command export_command();
[[nodiscard]] Command certify_command();
[[nodiscard]] Command info_command();
[[nodiscard]] Command init_command();
[[nodiscard]] Command defaults_command();
[[nodiscard]] Command help_command();

/// Options in place of a command.
[[nodiscard]] std::span<const Option> program_options();

/// Examples of the whole program, for the end of its help.
[[nodiscard]] std::string_view program_examples();

/// The program in one line.
inline constexpr std::string_view program_summary = "exact sweeps of oscillators that knock against stops";

/// The help of the program, and of one command.
[[nodiscard]] std::string program_help();
[[nodiscard]] std::string command_help(const Command& command);

}  // namespace clatter::app
