#include <algorithm>
#include <iostream>

#include "commands.hpp"
#include "io/defaults.hpp"
#include "io/suggestion.hpp"

namespace clatter {
namespace {

constexpr std::string_view exit_codes = R"(Exit codes
  0    done
  1    done, but some points failed; their status says why
  2    wrong command line or configuration
  70   a bug in clatter
  74   a file cannot be read or written
  75   another run is writing the output
  124  --max-time is over
  130  stopped by SIGINT; 143: by SIGTERM
)";

/// Two columns: words, and what they mean.
std::string line(std::string_view left, std::string_view right) {
  constexpr std::size_t column = 34;
  std::string text = "  " + std::string(left);
  text.resize(std::max(text.size() + 2, column), ' ');
  return text + std::string(right) + '\n';
}

std::string option_line(const Option& option) {
  const std::string letter = option.letter != 0 ? std::string{'-', option.letter, ',', ' '} : "    ";
  const std::string argument = option.argument.empty() ? "" : ' ' + std::string(option.argument);
  return line(letter + "--" + std::string(option.name) + argument, option.help);
}

int print_help(const Arguments& arguments) {
  if (arguments.operands.empty()) {
    std::cout << program_help();
  } else if (arguments.operands[0] == "configuration") {
    std::cout << configuration_reference();
  } else {
    std::vector<std::string_view> topics{"configuration"};
    for (const Command& command : commands()) topics.push_back(command.name);
    const std::string& topic = arguments.operands[0];
    if (std::find(topics.begin(), topics.end(), topic) == topics.end()) {
      throw UsageError("no help on " + in_quotes(topic) + suggestion(topic, topics, "; there is help on: "));
    }
    std::cout << command_help(find_command(topic));
  }
  return done;
}

constexpr std::string_view examples =
    "  clatter help run\n"
    "  clatter help configuration\n";

}  // namespace

std::string command_help(const Command& command) {
  std::string text = "clatter " + std::string(command.usage) + "\n\n" + std::string(command.summary) + "\n\nOptions\n";
  for (const Option& option : command.options) text += option_line(option);
  return text + "\nExamples\n" + std::string(command.examples);
}

std::string program_help() {
  std::string text = "clatter: exact sweeps of oscillators between rigid stops\n\nCommands\n";
  for (const Command& command : commands()) text += line(command.usage, command.summary);
  text += line("--version", "print version, commit and compiler");
  text += line("--help", "print this help");
  text += '\n' + std::string(exit_codes) + "\nExamples\n";
  text +=
      "  clatter run configs/fig22.toml\n"
      "  clatter run configs/fig22.toml -o coarse.h5 --set sweep.nu='linspace(0.5, 1.5, 51)'\n"
      "  clatter info fig22.h5\n"
      "  clatter help configuration\n";
  return text;
}

Command help_command() {
  return {.name = "help",
          .usage = "help [COMMAND]",
          .summary = "print the help of a command, or of the configuration's keys",
          .examples = examples,
          .operands = {"COMMAND"},
          .required_operands = 0,
          .options = {{"help", 'h', "", "print this help"}},
          .run = print_help};
}

}  // namespace clatter
