#include "help/completion_tables.hpp"
#include "help/completions.hpp"

namespace clatter::app {
namespace {

std::vector<std::string_view> command_names() {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return names;
}

/// The values of a key as compgen splits them: a value with a blank is one word, with the backslash that a shell needs.
std::string bash_values(const Setting& setting) {
  std::vector<std::string> words;
  for (const std::string_view value : setting.values) {
    std::string word;
    for (const char c : value) (word += c == ' ' ? "\\" : "") += c;
    words.push_back(word.size() > value.size() ? '"' + word + '"' : word);
  }
  return shell_quoted(joined(words, " "));
}

/// The call that offers it.
std::string bash_call(const Offer& offer) {
  switch (offer.kind) {
    case Offer::Kind::words:
      return "_clatter_words " + shell_quoted(joined(offer.words, " "));
    case Offer::Kind::files:
      return "_clatter_files " + joined(offer.words, " ");
    case Offer::Kind::folders:
      return "_clatter_files";
    case Offer::Kind::settings:
      return "_clatter_settings";
    case Offer::Kind::nothing:
      break;
  }
  return ":";
}

std::string bash_case(const Command& command) {
  std::string text = "    " + std::string(command.name) + ")\n      case $before in\n";
  for (const Option& option : command.options)
    if (!option.argument.empty())
      text += "        " + joined(written(option), " | ") + ") " +
              bash_call(offer_for(option.argument, option.choices)) + "; return ;;\n";
  return text + "      esac\n      if [[ $current == -* ]]; then _clatter_words " +
         shell_quoted(joined(written(command.options), " ")) + "; else " + bash_call(operand_of(command)) + "; fi ;;\n";
}

constexpr std::string_view bash_functions = R"bash(# bash completion of clatter; `clatter help --manual DIR` writes it.

# Of these words, those that begin like the current one.
_clatter_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}

# Files with these endings, and folders.
_clatter_files() {
  local ending
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -d -- "$current"; for ending; do compgen -f -X "!*.$ending" -- "$current"; done)
}

# KEY=VALUE. The value of a number isn't known, so that which is permitted is shown; an empty word keeps bash from
# writing it.
_clatter_settings() {
  local key=${current%%=*} values="" permitted="" before_value=""
  if [[ $current != *=* ]]; then
    compopt -o nospace
    mapfile -t COMPREPLY < <(compgen -S = -W "$_clatter_keys" -- "$current")
    return
  fi
  current=${current#*=}
  _clatter_values "$key"
  if [[ -n $values ]]; then
    [[ $COMP_WORDBREAKS == *=* ]] || before_value=$key=
    mapfile -t COMPREPLY < <(compgen -P "$before_value" -W "$values" -- "$current")
  elif [[ -z $current && -n $permitted ]]; then
    COMPREPLY=("$permitted" " ")
  fi
}

)bash";

constexpr std::string_view bash_begin = R"bash(_clatter() {
  local line=${COMP_LINE:0:COMP_POINT}
  local -a words
  read -ra words <<<"$line"
  [[ $line != *[[:space:]] ]] || words+=("")
  local current=${words[-1]} before=${words[-2]}
  if ((${#words[@]} == 2)); then
)bash";

}  // namespace

std::string bash_completion() {
  std::string names, values;
  for (const Setting& setting : settings()) {
    (names += names.empty() ? "" : " ") += setting.name;
    values += "    " + setting.name + ") ";
    values +=
        setting.values.empty() ? "permitted=" + shell_quoted(setting.permitted) : "values=" + bash_values(setting);
    values += " ;;\n";
  }
  std::string text = std::string(bash_functions) + "_clatter_keys=" + shell_quoted(names) +
                     "\n\n_clatter_values() {\n  case $1 in\n" + values + "  esac\n}\n\n" + std::string(bash_begin) +
                     "    _clatter_words " +
                     shell_quoted(joined(command_names(), " ") + ' ' + joined(written(program_options()), " ")) +
                     "\n    return\n  fi\n  case ${words[1]} in\n";
  for (const Command& command : commands()) text += bash_case(command);
  return text + "  esac\n}\ncomplete -F _clatter clatter\n";
}

}  // namespace clatter::app
