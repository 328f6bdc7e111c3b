#include <iostream>

#include "commands/commands.hpp"
#include "config/config_text.hpp"
#include "help/config_schema.hpp"

namespace clatter::app {
namespace {

int print_defaults(const Arguments& arguments) {
  if (arguments.has("schema")) {
    if (arguments.has("ini")) throw UsageError("--schema conflicts with --ini; a JSON Schema is of TOML");
    std::cout << config_schema();
    return done;
  }
  std::cout << default_config(arguments.has("ini") ? config::Format::ini : config::Format::toml);
  return done;
}

constexpr std::string_view defaults_examples =
    "  clatter defaults > new.toml\n"
    "  clatter defaults --ini > new.ini\n"
    "  clatter defaults --schema > clatter.schema.json\n";

}  // namespace

Command defaults_command() {
  return {.name = "defaults",
          .usage = "defaults [--ini|--schema]",
          .summary = "print a complete commented configuration that runs",
          .examples = defaults_examples,
          .operands = {},
          .required_operands = 0,
          .options = {{"ini", 0, "", "as INI instead of TOML"},
                      {"schema", 0, "", "print the keys as a JSON Schema instead, for editors of TOML"},
                      {"help", 'h', "", "print this help"}},
          .run = print_defaults};
}

}  // namespace clatter::app
