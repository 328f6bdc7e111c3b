#include "terminal/command_line.hpp"

#include <algorithm>
#include <boost/program_options.hpp>

#include "commands/commands.hpp"
#include "config/suggestion.hpp"

namespace clatter::app {
namespace {

namespace po = boost::program_options;

constexpr auto style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;

std::string help_hint(const Command& command) { return "; see `clatter help " + std::string(command.name) + "`"; }

po::options_description description_of(const Command& command) {
  po::options_description description;
  for (const Option& option : command.options) {
    const std::string names = std::string(option.name) + (option.letter != 0 ? std::string{',', option.letter} : "");
    if (option.argument.empty()) {
      description.add_options()(names.c_str(), po::bool_switch(), "");
    } else {
      description.add_options()(names.c_str(), po::value<std::string>(), "");
    }
  }
  return description;
}

std::vector<std::string> names_of(const Command& command) {
  std::vector<std::string> names;
  for (const Option& option : command.options) names.push_back("--" + std::string(option.name));
  return names;
}

/// The option nearest to the written one, with its dashes; empty if none is near. Abbreviations are refused, not
/// expanded.
std::string meant(const std::string& written, const std::vector<std::string>& names) {
  if (written.size() < 3) return {};  // a letter
  const std::vector<std::string_view> views(names.begin(), names.end());
  return std::string(config::nearest(written.starts_with("--") ? written : '-' + written, views));
}

std::string unknown_option(const Command& command, const std::string& written) {
  const std::string near = meant(written, names_of(command));
  const std::string message = "unknown option " + config::in_quotes(written);
  return near.empty() ? message + help_hint(command) : message + "; did you mean " + config::in_quotes(near) + "?";
}

/// Throws an error of Boost's as one line with how to fix it.
[[noreturn]] void refuse(const Command& command, const po::error& error) {
  if (const auto* const unknown = dynamic_cast<const po::unknown_option*>(&error)) {
    throw UsageError(unknown_option(command, unknown->get_option_name()));
  }
  throw UsageError(std::string(error.what()) + help_hint(command));
}

void check_operands(const Command& command, const std::vector<std::string>& operands) {
  if (operands.size() < command.required_operands) {
    throw UsageError(std::string(command.operands[operands.size()]) + " is missing; write: clatter " +
                     std::string(command.usage));
  }
  if (operands.size() > command.operands.size() && !command.repeats_last) {
    throw UsageError("unexpected argument " + config::in_quotes(operands[command.operands.size()]) +
                     "; write: clatter " + std::string(command.usage));
  }
}

Arguments collect(const Command& command, const po::parsed_options& parsed) {
  Arguments arguments;
  for (const auto& option : parsed.options) {
    if (option.position_key >= 0) {
      arguments.operands.insert(arguments.operands.end(), option.value.begin(), option.value.end());
      continue;
    }
    const bool again = arguments.has(option.string_key);
    for (const Option& known : command.options) {
      if (known.name != option.string_key || !again || known.repeatable || known.argument.empty()) continue;
      throw UsageError("option '--" + option.string_key + "' is given twice; give it once");
    }
    auto& values = arguments.options[option.string_key];
    values.insert(values.end(), option.value.begin(), option.value.end());
  }
  return arguments;
}

/// Refuses standard output for HDF5, which is not written as a stream.
void check_output(const Command& command, const Arguments& arguments) {
  const auto output = std::ranges::find(command.options, "output", &Option::name);
  if (arguments.value("output") == "-" && output->argument == "FILE.h5")
    throw UsageError("-o - is no file, and HDF5 can't go to standard output; name a file (./- for one called -)");
}

}  // namespace

std::optional<std::string> Arguments::value(std::string_view option) const {
  const auto found = options.find(option);
  return found == options.end() || found->second.empty() ? std::nullopt : std::optional(found->second.back());
}

std::vector<std::string> Arguments::values(std::string_view option) const {
  const auto found = options.find(option);
  return found == options.end() ? std::vector<std::string>{} : found->second;
}

void refuse_option(const std::string& written) {
  const std::string message = "unknown option " + config::in_quotes(written) + " before the command";
  const std::vector<std::string> own{"--help", "--version", "--cite"};
  std::vector<std::string> all = own;
  for (const Command& command : commands()) {
    for (const std::string& name : names_of(command)) all.push_back(name);
  }
  const std::string near = meant(written, all);
  if (near.empty()) throw UsageError(message + "; see `clatter --help`");
  if (std::ranges::find(own, near) != own.end())
    throw UsageError(message + "; did you mean " + config::in_quotes(near) + "?");
  throw UsageError(message + "; write it behind: clatter COMMAND ... " + near);
}

Arguments parse_arguments(const Command& command, const std::vector<std::string>& words) {
  const po::options_description description = description_of(command);
  po::positional_options_description operands;
  operands.add("operand", -1);
  try {
    const auto parsed = po::command_line_parser(words).options(description).positional(operands).style(style).run();
    Arguments arguments = collect(command, parsed);
    if (!arguments.has("help")) check_operands(command, arguments.operands), check_output(command, arguments);
    return arguments;
  } catch (const po::error& error) {
    refuse(command, error);
  }
}

}  // namespace clatter::app
