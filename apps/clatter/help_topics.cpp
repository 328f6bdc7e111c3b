#include "help_topics.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "config/axis_functions.hpp"
#include "config/reference.hpp"
#include "config/suggestion.hpp"

namespace clatter::app {
namespace {

constexpr std::string_view whole = "configuration";

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// The keys that a topic names: one by "R" or "scene.R", two by "tolerance".
std::vector<const Key*> keys_named(std::string_view topic) {
  std::vector<const Key*> named;
  const std::size_t dot = topic.find('.');
  if (dot != std::string_view::npos) {
    const Key* const key = config::find_key(topic.substr(0, dot), topic.substr(dot + 1));
    if (key != nullptr) named.push_back(key);
    return named;
  }
  for (const Key& key : config::keys()) {
    if (key.name == topic) named.push_back(&key);
  }
  return named;
}

std::string references(const std::vector<const Key*>& named) {
  std::string text;
  for (const Key* const key : named) (text += text.empty() ? "" : "\n\n") += config::key_reference(*key);
  return text;
}

[[noreturn]] void refuse(const std::string& topic) {
  const std::vector<std::string> all = help_topics();  // the first of equally near ones is suggested
  const std::vector<std::string_view> names(all.begin(), all.end());
  if (const std::string_view near = config::nearest(topic, names); !near.empty())
    throw UsageError("no help on " + config::in_quotes(topic) + "; did you mean '" + std::string(near) + "'?");
  std::vector<std::string_view> first{whole};
  for (const Command& command : commands()) first.push_back(command.name);
  throw UsageError("no help on " + config::in_quotes(topic) + "; there is help on: " + config::joined(first) +
                   ", and on every section and key");
}

}  // namespace

std::vector<std::string> help_topics() {
  std::vector<std::string> all;
  for (const Command& command : commands()) all.emplace_back(command.name);
  all.emplace_back(whole);
  for (const Key& key : config::keys()) all.emplace_back(key.name);
  for (const std::string_view section : config::sections()) {
    all.emplace_back(section);
    for (const std::string_view name : config::key_names(section))
      all.push_back(std::string(section) + '.' + std::string(name));
  }
  for (const std::string_view function : config::axis_function_names()) all.emplace_back(function);
  return all;
}

std::string help_on(const std::string& topic) {
  std::string_view name = topic;
  if (name == whole) return config::configuration_reference();
  for (const Command& command : commands()) {
    if (command.name == name) return command_help(command);
  }
  const std::vector<const Key*> named = keys_named(name);
  if (!named.empty()) return references(named);
  if (contains(config::axis_function_names(), name)) return std::string(config::value_reference());
  if (name.starts_with('[') && name.ends_with(']')) name = name.substr(1, name.size() - 2);
  if (contains(config::sections(), name)) return config::section_reference(name);
  refuse(topic);
}

}  // namespace clatter::app
