#include "commands/commands.hpp"

#include "config/suggestion.hpp"

namespace clatter::app {

std::span<const Command> commands() {
  static const std::vector<Command> all{run_command(),   plan_command(),     accuracy_command(), branch_command(),
                                        merge_command(), export_command(),   certify_command(),  info_command(),
                                        init_command(),  defaults_command(), help_command()};
  return all;
}

const Command& find_command(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) {
    if (command.name == name) return command;
    names.push_back(command.name);
  }
  if (name == "plot" || name == "report")
    throw UsageError("clatter draws nothing; use clatter-" + std::string(name) + ", or scripts/" + std::string(name) +
                     ".py");
  if (name.ends_with(".toml") || name.ends_with(".ini"))
    throw UsageError("no command before " + config::in_quotes(name) + "; write e.g. clatter run " + std::string(name));
  throw UsageError("unknown command " + config::in_quotes(name) +
                   config::suggestion(name, names, "; the commands are: "));
}

}  // namespace clatter::app
