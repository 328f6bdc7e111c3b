#include "help/completion_tables.hpp"
#include "help/completions.hpp"

namespace clatter::app {
namespace {

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
    text +=
        " \\\n        " + shell_quoted((option.repeatable ? "*" : '(' + joined(forms, " ") + ')') + form + explained);
  return text;
}

std::string zsh_case(const Command& command) {
  std::string text = "    " + std::string(command.name) + ")\n      _arguments -S";
  for (const Option& option : command.options) text += zsh_option(option);
  if (!command.operands.empty())
    text += " \\\n        " + shell_quoted((command.repeats_last ? "*:" : "1:") + plain(command.operands.back()) + ':' +
                                           zsh_action(operand_of(command)));
  return text + " ;;\n";
}

std::string zsh_values(const Setting& setting) {
  std::string words;
  for (const std::string_view value : setting.values) words += ' ' + shell_quoted(std::string(value));
  return words;
}

}  // namespace

std::string zsh_completion() {
  std::string keys, values;
  for (const Setting& setting : settings()) {
    keys += "    " + shell_quoted(setting.name + ':' + setting.help + "; " + setting.permitted) + '\n';
    values += "      " + setting.name + ") ";
    values +=
        setting.values.empty() ? "compadd -x " + shell_quoted(setting.permitted) : "compadd" + zsh_values(setting);
    values += " ;;\n";
  }
  std::string text =
      "#compdef clatter\n# zsh completion of clatter; `clatter help --manual DIR` writes it.\n\n_clatter_settings() {\n"
      "  local -a keys=(\n" +
      keys + "  )\n  if compset -P 1 '*='; then\n    case ${IPREFIX%=} in\n" + values +
      "    esac\n  else\n    _describe -t keys 'key of the configuration' keys -S =\n  fi\n}\n\n"
      "_clatter_commands() {\n  local -a commands=(\n";
  for (const Command& command : commands())
    text += "    " + shell_quoted(std::string(command.name) + ':' + std::string(command.summary)) + '\n';
  text +=
      "  )\n  _describe -t commands command commands\n}\n\n_clatter() {\n  local curcontext=$curcontext state line\n"
      "  _arguments -C";
  for (const Option& option : program_options())
    text += " \\\n    " + shell_quoted("(- *)--" + std::string(option.name) + '[' + plain(option.help) + ']');
  text +=
      " \\\n    '1: :_clatter_commands' \\\n    '*:: :->arguments'\n"
      "  [[ $state == arguments ]] || return\n  case $words[1] in\n";
  for (const Command& command : commands()) text += zsh_case(command);
  return text + "  esac\n}\n\n_clatter \"$@\"\n";
}

}  // namespace clatter::app
