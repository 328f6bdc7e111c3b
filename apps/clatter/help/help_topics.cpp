#include "help/help_topics.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "commands/commands.hpp"
#include "config/axis_functions.hpp"
#include "config/reference.hpp"
#include "config/suggestion.hpp"
#include "help/result_catalogue.hpp"
#include "help/result_help.hpp"

namespace clatter::app {
namespace {

constexpr std::string_view whole_topic = "configuration", all_results = "results", units_topic = "units";

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

std::string references(const std::vector<const CataloguedResult*>& named) {
  std::string text;
  for (const CataloguedResult* const result : named) (text += text.empty() ? "" : "\n\n") += result_reference(*result);
  return text;
}

/// Two parts of a page; either may be empty.
std::string both(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "\n\n") + second;
}

[[noreturn]] void refuse(const std::string& topic) {
  const std::vector<std::string> all = help_topics();  // the first of equally near ones is suggested
  const std::vector<std::string_view> names(all.begin(), all.end());
  if (const std::string_view near = config::nearest(topic, names); !near.empty())
    throw UsageError("no help on " + config::in_quotes(topic) + "; did you mean '" + std::string(near) + "'?");
  std::vector<std::string_view> first{whole_topic};
  for (const Command& command : commands()) first.push_back(command.name);
  first.insert(first.end(), {all_results, units_topic});
  throw UsageError("no help on " + config::in_quotes(topic) + "; there is help on: " + config::joined(first) +
                   ", and on every section, key and result");
}

}  // namespace

std::vector<std::string> help_topics() {
  std::vector<std::string> all;
  for (const Command& command : commands()) all.emplace_back(command.name);
  all.emplace_back(whole_topic);
  for (const Key& key : config::keys()) all.emplace_back(key.name);
  for (const std::string_view section : config::sections()) {
    all.emplace_back(section);
    for (const std::string_view name : config::key_names(section))
      all.push_back(std::string(section) + '.' + std::string(name));
  }
  for (const std::string_view function : config::axis_function_names()) all.emplace_back(function);
  all.emplace_back(all_results), all.emplace_back(units_topic);
  for (const CataloguedResult& result : result_catalogue())
    if (std::ranges::find(all, result.name) == all.end()) all.push_back(result.name);
  return all;
}

std::string help_on(const std::string& topic) {
  std::string_view name = topic;
  if (name == whole_topic) return config::configuration_reference();
  if (name == all_results) return list_of_results();
  const std::string of_results = references(results_named(name));
  for (const Command& command : commands()) {
    if (command.name == name) return both(command_help(command), of_results);
  }
  const std::vector<const Key*> named = keys_named(name);
  if (!named.empty() || !of_results.empty()) return both(references(named), of_results);
  if (name == units_topic || contains(config::axis_function_names(), name))
    return std::string(config::value_reference());
  if (name.starts_with('[') && name.ends_with(']')) name = name.substr(1, name.size() - 2);
  if (contains(config::sections(), name)) return config::section_reference(name);
  refuse(topic);
}

}  // namespace clatter::app
