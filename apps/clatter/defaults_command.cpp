#include <iostream>

#include "commands.hpp"
#include "config/config_text.hpp"

namespace clatter::app {
namespace {

int print_defaults(const Arguments& arguments) {
  std::cout << default_config(arguments.has("ini") ? config::Format::ini : config::Format::toml);
  return done;
}

constexpr std::string_view examples =
    "  clatter defaults > new.toml\n"
    "  clatter defaults --ini > new.ini\n";

}  // namespace

Command defaults_command() {
  return {.name = "defaults",
          .usage = "defaults [--ini]",
          .summary = "print a complete commented configuration that runs",
          .examples = examples,
          .operands = {},
          .required_operands = 0,
          .options = {{"ini", 0, "", "as INI instead of TOML"}, {"help", 'h', "", "print this help"}},
          .run = print_defaults};
}

}  // namespace clatter::app
