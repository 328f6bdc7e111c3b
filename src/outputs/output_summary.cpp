#include "outputs/output_summary.hpp"

#include <algorithm>
#include <optional>

#include "storage/input_file.hpp"
#include "sweep/share.hpp"

namespace clatter::outputs {
namespace {

/// The text of an attribute; nullptr: there is none.
const std::string* attribute_of(const results::FileSummary& summary, std::string_view name) {
  const auto found = std::ranges::find(summary.attributes, name, [](const auto& attribute) { return attribute.first; });
  return found == summary.attributes.end() ? nullptr : &found->second;
}

/// The number of points by the configuration in the file.
std::optional<std::size_t> points_told(const results::FileSummary& summary, const std::string& path) try {
  const std::string *const text = attribute_of(summary, "config"), *const shard = attribute_of(summary, "shard");
  if (text == nullptr) return std::nullopt;
  const config::Config config = config::parse_config(*text, path);
  return sweep::Share(config.sweep, shard == nullptr ? std::nullopt : results::shard_named(*shard)).points();
} catch (const config::ConfigError&) {
  return std::nullopt;
}

}  // namespace

results::FileSummary read_summary(const std::string& path) {
  results::FileSummary summary = results::read_summary(path);
  const auto status = std::ranges::find(summary.variables, "status", &results::FileSummary::Entry::name);
  if (status == summary.variables.end()) return summary;
  double points = 1;
  for (const results::NamedLength& dimension : status->dimensions)
    if (dimension.name != "row") points *= static_cast<double>(dimension.length);  // of `clatter accuracy`
  const std::optional<std::size_t> told = points_told(summary, path);
  if (told && points != static_cast<double>(*told))
    results::refuse_damaged(path,
                            "its 'status' doesn't have the " + std::to_string(*told) + " points of its configuration");
  return summary;
}

config::Config config_of_output(const results::FileSummary& summary, const std::string& path) try {
  const std::string* const text = attribute_of(summary, "config");
  if (text == nullptr) storage::refuse_reading(path, "has no configuration", "name an output of clatter");
  return config::parse_config(*text, path);
} catch (const config::ConfigError& error) {
  storage::refuse_reading(path, std::string("has a configuration that doesn't run: ") + error.what(),
                          "run its configuration again");
}

}  // namespace clatter::outputs
