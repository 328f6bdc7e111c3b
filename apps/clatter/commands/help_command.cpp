#include <algorithm>
#include <filesystem>
#include <iostream>

#include "commands/commands.hpp"
#include "config/config_error.hpp"
#include "config/reading.hpp"
#include "config/suggestion.hpp"
#include "config/wrapped.hpp"
#include "help/completions.hpp"
#include "help/help_topics.hpp"
#include "help/manual_pages.hpp"
#include "storage/atomic_write.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"
#include "tables/json_output.hpp"

namespace clatter::app {
namespace {

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

/// Writes a file of the manual; makes its folder if need be.
void write_below(const std::filesystem::path& folder, const std::string& name, const std::string& text) {
  const std::filesystem::path path = folder / name;
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    throw storage::IoError("cannot make the folder " + storage::quoted_name(path.parent_path().string()) + ": " +
                           error.message());
  storage::write_atomically(path.string(), text);
}

void write_manual(const std::filesystem::path& folder) {
  for (const ManualPage& page : manual_pages()) write_below(folder, page.path, page.text);
  write_below(folder, "bash-completion/completions/clatter.bash", bash_completion());
  write_below(folder, "zsh/site-functions/_clatter", zsh_completion());
  write_below(folder, "fish/vendor_completions.d/clatter.fish", fish_completion());
}

/// The value whose unit scripts ask for. Throws UsageError.
config::Reading reading_of(const Arguments& arguments) try {
  if (arguments.operands.empty()) throw UsageError("--json without a value; write e.g. clatter help --json '1.5 mm'");
  return config::parse_reading({arguments.operands[0], {.source = config::in_quotes(arguments.operands[0])}});
} catch (const config::ConfigError& error) {
  throw UsageError(std::string(error.what()) + "; --json takes a value, e.g. '1.5 mm'");
}

int print_help(const Arguments& arguments) {
  if (const std::optional<std::string> folder = arguments.value("manual")) {
    if (!arguments.operands.empty())
      throw UsageError("--manual conflicts with " + config::in_quotes(arguments.operands[0]) +
                       "; it writes all pages, so leave that out");
    write_manual(*folder);
    return done;
  }
  if (arguments.has("json"))
    std::cout << reading_json(reading_of(arguments));
  else
    std::cout << (arguments.operands.empty() ? program_help() : help_on(arguments.operands[0]));
  return done;
}

constexpr std::string_view help_examples =
    "  clatter help run\n"
    "  clatter help configuration\n"
    "  clatter help R                also scene.R, sweep.R, [scene], linspace\n"
    "  clatter help impact_speed     a result; help results lists them\n"
    "  clatter help --json '1.5 mm'\n"
    "  clatter help --manual ~/.local/share\n";

constexpr Option options_of_program[] = {{"version", 0, "", "print version, commit and compiler"},
                                         {"cite", 0, "", "print BibTeX to cite clatter"},
                                         {"help", 0, "", "print this help"}};

constexpr ExitMeaning meanings[] = {
    {"0", "done"},
    {"1", "done, but some points failed; their status says why"},
    {"2", "wrong command line or configuration"},
    {"70", "a bug in clatter"},
    {"74", "a file cannot be read or written, or the system refuses memory, threads, stacks or open files"},
    {"75", "another run is writing the output"},
    {"124", "stopped by --max-time"},
    {"129", "stopped by SIGHUP; 130: by SIGINT; 143: by SIGTERM"}};

}  // namespace

std::string command_help(const Command& command) {
  std::vector<Row> rows;
  for (const Option& option : command.options) rows.push_back(row_of(option));
  return "clatter " + std::string(command.usage) + "\n\n" + config::wrapped(command.summary, 0) + "\nOptions\n" +
         table(rows) + (command.notes.empty() ? "" : "\nNotes\n  " + config::wrapped(command.notes, 2)) +
         "\nExamples\n" + std::string(command.examples);
}

std::string program_help() {
  std::vector<Row> rows;
  for (const Command& command : commands()) rows.emplace_back(command.usage, command.summary);
  for (const Option& option : program_options()) rows.emplace_back("--" + std::string(option.name), option.help);
  std::vector<Row> codes;
  for (const ExitMeaning& exit : exit_meanings()) codes.emplace_back(exit.code, exit.meaning);
  return "clatter: " + std::string(program_summary) + "\n\nCommands\n" + table(rows) + "\nExit codes\n" + table(codes) +
         "\nExamples\n" + std::string(program_examples());
}

std::span<const ExitMeaning> exit_meanings() { return meanings; }

std::span<const Option> program_options() { return options_of_program; }

std::string_view program_examples() {
  return "  clatter run configs/fig22.toml\n"
         "  clatter run configs/fig22.toml -o coarse.h5 \\\n"
         "    --set sweep.nu='linspace(0.5, 1.5, 51)'\n"
         "  clatter info fig22.h5\n"
         "  clatter help configuration\n"
         "  clatter help R\n";
}

Command help_command() {
  return {
      .name = "help",
      .usage = "help [COMMAND|KEY|RESULT]",
      .summary =
          "explain a command, a key of the configuration with an example, a result, or all keys (help configuration)",
      .examples = help_examples,
      .operands = {"COMMAND|KEY|RESULT"},
      .required_operands = 0,
      .options = {{"manual", 0, "DIR",
                   "write the man pages, and completions for bash, zsh and fish, laid out as in PREFIX/share"},
                  {"json", 0, "", "print a value, e.g. '1.5 mm', as JSON: its number and its unit in SI"},
                  {"help", 'h', "", "print this help"}},
      .run = print_help};
}

}  // namespace clatter::app
