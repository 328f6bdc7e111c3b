#include "help/completion_tables.hpp"

#include "config/keys.hpp"
#include "config/reference.hpp"
#include "help/help_topics.hpp"
#include "help/models.hpp"

namespace clatter::app {
namespace {

std::vector<std::string> names_of_models() {
  std::vector<std::string> names;
  for (const Model& model : models()) names.emplace_back(model.name);
  return names;
}

}  // namespace

Offer offer_for(std::string_view argument, std::span<const std::string_view> choices) {
  using enum Offer::Kind;
  if (!choices.empty()) return {words, {choices.begin(), choices.end()}};
  if (argument == "CONFIG") return {files, {"toml", "ini"}};
  if (argument == "KEY=VALUE") return {settings};
  if (argument == "DIR") return {folders};
  if (argument == "COMMAND|KEY|RESULT") return {words, help_topics()};
  if (argument == "MODEL") return {words, names_of_models()};
  const std::size_t dot = argument.rfind('.');
  if (dot != std::string_view::npos && argument.find(',') == std::string_view::npos)
    return {files, {std::string(argument.substr(dot + 1))}};
  return {};
}

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
      if (key.kind == Kind::choices) all.back().values.emplace_back(config::no_choice);
    }
  }
  return all;
}

std::string replaced(std::string text, std::string_view old, std::string_view with) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + with.size()))
    text.replace(at, old.size(), with);
  return text;
}

std::string shell_quoted(const std::string& text) { return '\'' + replaced(text, "'", R"('\'')") + '\''; }

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

Offer operand_of(const Command& command) {
  return command.operands.empty() ? Offer{} : offer_for(command.operands.back());
}

}  // namespace clatter::app
