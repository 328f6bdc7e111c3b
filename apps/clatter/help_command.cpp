#include <algorithm>
#include <iostream>

#include "commands.hpp"
#include "config/wrapped.hpp"
#include "help_topics.hpp"

namespace clatter::app {
namespace {

constexpr std::string_view exit_codes = R"(Exit codes
  0    done
  1    done, but some points failed; their status says why
  2    wrong command line or configuration
  70   a bug in clatter
  74   a file cannot be read or written, or the system refuses memory,
       threads, stacks or open files
  75   another run is writing the output
  124  stopped by --max-time
  129  stopped by SIGHUP; 130: by SIGINT; 143: by SIGTERM
)";

/// A term and its explanation.
using Row = std::pair<std::string, std::string_view>;

/// Two columns; the first is as wide as its longest term.
std::string table(const std::vector<Row>& rows) {
  std::size_t column = 0;
  for (const auto& [left, right] : rows) column = std::max(column, left.size() + 4);
  std::string text;
  for (const auto& [left, right] : rows) {
    std::string words = "  " + left;
    words.resize(column, ' ');
    text += words + config::wrapped(right, column);
  }
  return text;
}

Row row_of(const Option& option) {
  const std::string letter = option.letter != 0 ? std::string{'-', option.letter, ',', ' '} : "    ";
  const std::string argument = option.argument.empty() ? "" : ' ' + std::string(option.argument);
  return {letter + "--" + std::string(option.name) + argument, option.help};
}

int print_help(const Arguments& arguments) {
  std::cout << (arguments.operands.empty() ? program_help() : help_on(arguments.operands[0]));
  return done;
}

constexpr std::string_view examples =
    "  clatter help run\n"
    "  clatter help configuration\n"
    "  clatter help R                also scene.R, sweep.R, [scene], linspace\n";

}  // namespace

std::string command_help(const Command& command) {
  std::vector<Row> rows;
  for (const Option& option : command.options) rows.push_back(row_of(option));
  return "clatter " + std::string(command.usage) + "\n\n" + config::wrapped(command.summary, 0) + "\nOptions\n" +
         table(rows) + "\nExamples\n" + std::string(command.examples);
}

std::string program_help() {
  std::vector<Row> rows;
  for (const Command& command : commands()) rows.emplace_back(command.usage, command.summary);
  rows.emplace_back("--version", "print version, commit and compiler");
  rows.emplace_back("--cite", "print BibTeX to cite clatter");
  rows.emplace_back("--help", "print this help");
  return "clatter: exact sweeps of oscillators between rigid stops\n\nCommands\n" + table(rows) + '\n' +
         std::string(exit_codes) +
         "\nExamples\n"
         "  clatter run configs/fig22.toml\n"
         "  clatter run configs/fig22.toml -o coarse.h5 \\\n"
         "    --set sweep.nu='linspace(0.5, 1.5, 51)'\n"
         "  clatter info fig22.h5\n"
         "  clatter help configuration\n"
         "  clatter help R\n";
}

Command help_command() {
  return {.name = "help",
          .usage = "help [COMMAND|KEY]",
          .summary =
              "print the help of a command, of a key of the configuration with an example, or of all "
              "keys: configuration",
          .examples = examples,
          .operands = {"COMMAND|KEY"},
          .required_operands = 0,
          .options = {{"help", 'h', "", "print this help"}},
          .run = print_help};
}

}  // namespace clatter::app
