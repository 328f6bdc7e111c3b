#include "help/completion_tables.hpp"
#include "help/completions.hpp"

namespace clatter::app {
namespace {

/// A word for fish.
std::string fish_quoted(std::string_view text) {
  return '\'' + replaced(replaced(std::string(text), "\\", "\\\\"), "'", "\\'") + '\'';
}

/// Options of `complete` that offer it.
std::string fish_offer(const Offer& offer) {
  switch (offer.kind) {
    case Offer::Kind::words:
      return " -x -a " + fish_quoted(joined(offer.words, " "));
    case Offer::Kind::files: {
      std::string calls;
      for (const std::string& ending : offer.words)
        (calls += calls.empty() ? "" : " ") += "(__fish_complete_suffix ." + ending + ')';
      return " -k -x -a " + fish_quoted(calls);
    }
    case Offer::Kind::folders:
      return " -x -a '(__fish_complete_directories)'";
    case Offer::Kind::settings:
      return " -x -a '(__clatter_settings)'";
    case Offer::Kind::nothing:
      break;
  }
  return " -x";
}

std::string fish_lines(const Command& command) {
  const std::string begin = "complete -c clatter -n '__clatter_command " + std::string(command.name) + '\'';
  std::string text;
  if (!command.operands.empty()) text += begin + fish_offer(operand_of(command)) + '\n';
  for (const Option& option : command.options) {
    text += begin + (option.letter != 0 ? " -s " + std::string{option.letter} : "") + " -l " + std::string(option.name);
    if (!option.argument.empty()) text += fish_offer(offer_for(option.argument, option.choices));
    text += " -d " + fish_quoted(option.help) + '\n';
  }
  return text;
}

constexpr std::string_view fish_begin = R"fish(# fish completion of clatter; `clatter help --manual DIR` writes it.

# Whether the line has this command; without a name, whether it has none.
function __clatter_command
    set -l words (commandline -opc)
    if set -q argv[1]
        test (count $words) -gt 1; and test $words[2] = $argv[1]
    else
        test (count $words) -eq 1
    end
end

function __clatter_settings
    printf '%s\t%s\n' \
)fish";

}  // namespace

std::string fish_completion() {
  std::string text(fish_begin);
  std::string lines;
  for (const Setting& setting : settings()) {
    const std::vector<std::string_view> values =
        setting.values.empty() ? std::vector<std::string_view>{""} : setting.values;
    for (const std::string_view value : values)
      (lines += lines.empty() ? "" : " \\\n") += "        " + fish_quoted(setting.name + '=' + std::string(value)) +
                                                 ' ' + fish_quoted(setting.help + "; " + setting.permitted);
  }
  text += lines + "\nend\n\ncomplete -c clatter -f\n";
  for (const Command& command : commands())
    text += "complete -c clatter -n __clatter_command -a " + std::string(command.name) + " -d " +
            fish_quoted(command.summary) + '\n';
  for (const Option& option : program_options())
    text += "complete -c clatter -n __clatter_command -l " + std::string(option.name) + " -d " +
            fish_quoted(option.help) + '\n';
  for (const Command& command : commands()) text += fish_lines(command);
  return text;
}

}  // namespace clatter::app
