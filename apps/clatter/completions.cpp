#include "completions.hpp"

#include <string_view>

#include "commands.hpp"
#include "config/keys.hpp"
#include "config/reference.hpp"
#include "help_topics.hpp"

namespace clatter::app {
namespace {

/// Offered for the argument of an option, or for an operand.
struct Offer {
  enum class Kind { nothing, words, files, folders, settings };
  Kind kind = Kind::nothing;
  std::vector<std::string> words{};  ///< or the endings of files
};

Offer offer_for(std::string_view argument, std::span<const std::string_view> choices = {}) {
  using enum Offer::Kind;
  if (!choices.empty()) return {words, {choices.begin(), choices.end()}};
  if (argument == "CONFIG") return {files, {"toml", "ini"}};
  if (argument == "KEY=VALUE") return {settings};
  if (argument == "DIR") return {folders};
  if (argument == "COMMAND|KEY") return {words, help_topics()};
  const std::size_t dot = argument.rfind('.');
  if (dot != std::string_view::npos && argument.find(',') == std::string_view::npos)
    return {files, {std::string(argument.substr(dot + 1))}};
  return {};
}

/// A key after --set.
struct Setting {
  std::string name;                      ///< "scene.R"
  std::string permitted;                 ///< "0 ... 1; default: 1"
  std::string help;                      ///< its meaning
  std::vector<std::string_view> values;  ///< all that it may be, if these are words
};

std::vector<Setting> settings() {
  constexpr std::string_view flags[] = {"true", "false"};
  std::vector<Setting> all;
  std::vector<std::string_view> sections{""};
  sections.insert(sections.end(), config::sections().begin(), config::sections().end());
  for (const std::string_view section : sections) {
    for (const std::string_view name : config::key_names(section)) {
      const Key& key = *config::find_key(section, name);
      const std::string full = (section.empty() ? "" : std::string(section) + '.') + std::string(name);
      if (key.section != section) {
        all.push_back({full,
                       "linspace(a, b, n), logspace(a, b, n), arange(a, b, step) or a list",
                       "axis: " + std::string(key.help),
                       {}});
        continue;
      }
      const std::span<const std::string_view> values = key.kind == Kind::flag ? flags : key.choices;
      all.push_back({full, config::permitted_and_default(key), std::string(key.help), {values.begin(), values.end()}});
    }
  }
  return all;
}

std::string replaced(std::string text, std::string_view old, std::string_view with) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + with.size()))
    text.replace(at, old.size(), with);
  return text;
}

/// A word for bash and zsh.
std::string quoted(const std::string& text) { return '\'' + replaced(text, "'", R"('\'')") + '\''; }

template <class Words>
std::string joined(const Words& words, std::string_view between) {
  std::string text;
  for (const auto& word : words) (text += text.empty() ? "" : between) += word;
  return text;
}

/// "-o" and "--output", or "--output" alone.
std::vector<std::string> written(const Option& option) {
  std::vector<std::string> forms;
  if (option.letter != 0) forms.push_back({'-', option.letter});
  forms.push_back("--" + std::string(option.name));
  return forms;
}

std::vector<std::string> written(std::span<const Option> options) {
  std::vector<std::string> all;
  for (const Option& option : options)
    for (std::string& form : written(option)) all.push_back(std::move(form));
  return all;
}

std::vector<std::string_view> command_names() {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return names;
}

Offer operand_of(const Command& command) {
  return command.operands.empty() ? Offer{} : offer_for(command.operands.back());
}

// ---- bash

/// The call that offers it.
std::string bash_call(const Offer& offer) {
  switch (offer.kind) {
    case Offer::Kind::words:
      return "_clatter_words " + quoted(joined(offer.words, " "));
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
         quoted(joined(written(command.options), " ")) + "; else " + bash_call(operand_of(command)) + "; fi ;;\n";
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

std::string bash_completion() {
  std::string names, values;
  for (const Setting& setting : settings()) {
    (names += names.empty() ? "" : " ") += setting.name;
    values += "    " + setting.name + ") ";
    values += setting.values.empty() ? "permitted=" + quoted(setting.permitted)
                                     : "values=" + quoted(joined(setting.values, " "));
    values += " ;;\n";
  }
  std::string text = std::string(bash_functions) + "_clatter_keys=" + quoted(names) +
                     "\n\n_clatter_values() {\n  case $1 in\n" + values + "  esac\n}\n\n" + std::string(bash_begin) +
                     "    _clatter_words " +
                     quoted(joined(command_names(), " ") + ' ' + joined(written(program_options()), " ")) +
                     "\n    return\n  fi\n  case ${words[1]} in\n";
  for (const Command& command : commands()) text += bash_case(command);
  return text + "  esac\n}\ncomplete -F _clatter clatter\n";
}

// ---- zsh

/// Text in which a colon or a bracket stands for itself.
std::string plain(std::string_view text) {
  std::string escaped(text);
  for (const std::string_view sign : {"\\", ":", "[", "]"})
    escaped = replaced(escaped, sign, std::string("\\").append(sign));
  return escaped;
}

std::string zsh_action(const Offer& offer) {
  switch (offer.kind) {
    case Offer::Kind::words:
      return '(' + joined(offer.words, " ") + ')';
    case Offer::Kind::files:
      return "_files -g \"*." + joined(offer.words, " *.") + '"';
    case Offer::Kind::folders:
      return "_files -/";
    case Offer::Kind::settings:
      return "_clatter_settings";
    case Offer::Kind::nothing:
      break;
  }
  return " ";
}

std::string zsh_option(const Option& option) {
  const std::vector<std::string> forms = written(option);
  const std::string explained = '[' + plain(option.help) + ']' +
                                (option.argument.empty() ? ""
                                                         : ':' + plain(option.argument) + ':' +
                                                               zsh_action(offer_for(option.argument, option.choices)));
  std::string text;
  for (const std::string& form : forms)
    text += " \\\n        " + quoted((option.repeatable ? "*" : '(' + joined(forms, " ") + ')') + form + explained);
  return text;
}

std::string zsh_case(const Command& command) {
  std::string text = "    " + std::string(command.name) + ")\n      _arguments -S";
  for (const Option& option : command.options) text += zsh_option(option);
  if (!command.operands.empty())
    text += " \\\n        " + quoted((command.repeats_last ? "*:" : "1:") + plain(command.operands.back()) + ':' +
                                     zsh_action(operand_of(command)));
  return text + " ;;\n";
}

std::string zsh_completion() {
  std::string keys, values;
  for (const Setting& setting : settings()) {
    keys += "    " + quoted(setting.name + ':' + setting.help + "; " + setting.permitted) + '\n';
    values += "      " + setting.name + ") ";
    values +=
        setting.values.empty() ? "compadd -x " + quoted(setting.permitted) : "compadd " + joined(setting.values, " ");
    values += " ;;\n";
  }
  std::string text =
      "#compdef clatter\n# zsh completion of clatter; `clatter help --manual DIR` writes it.\n\n_clatter_settings() {\n"
      "  local -a keys=(\n" +
      keys + "  )\n  if compset -P 1 '*='; then\n    case ${IPREFIX%=} in\n" + values +
      "    esac\n  else\n    _describe -t keys 'key of the configuration' keys -S =\n  fi\n}\n\n"
      "_clatter_commands() {\n  local -a commands=(\n";
  for (const Command& command : commands())
    text += "    " + quoted(std::string(command.name) + ':' + std::string(command.summary)) + '\n';
  text +=
      "  )\n  _describe -t commands command commands\n}\n\n_clatter() {\n  local curcontext=$curcontext state line\n"
      "  _arguments -C";
  for (const Option& option : program_options())
    text += " \\\n    " + quoted("(- *)--" + std::string(option.name) + '[' + plain(option.help) + ']');
  text +=
      " \\\n    '1: :_clatter_commands' \\\n    '*:: :->arguments'\n"
      "  [[ $state == arguments ]] || return\n  case $words[1] in\n";
  for (const Command& command : commands()) text += zsh_case(command);
  return text + "  esac\n}\n\n_clatter \"$@\"\n";
}

// ---- fish

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

}  // namespace

std::vector<ManualFile> completions() {
  return {{"bash-completion/completions/clatter.bash", bash_completion()},
          {"zsh/site-functions/_clatter", zsh_completion()},
          {"fish/vendor_completions.d/clatter.fish", fish_completion()}};
}

}  // namespace clatter::app
