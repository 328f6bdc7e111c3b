#include "outputs/output_summary.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "storage/input_file.hpp"
#include "storage/run_in_child.hpp"
#include "sweep/share.hpp"

namespace clatter::outputs {
namespace {

/// The text of an attribute; nullptr: there is none.
const std::string* attribute_of(const results::FileSummary& summary, std::string_view name) {
  const auto found = std::ranges::find(summary.attributes, name, [](const auto& attribute) { return attribute.first; });
  return found == summary.attributes.end() ? nullptr : &found->second;
}

/// The number of points by the configuration in the file, as text; empty: that isn't known.
std::string points_told(const results::FileSummary& summary, const std::string& path) try {
  const std::string *const text = attribute_of(summary, "config"), *const shard = attribute_of(summary, "shard");
  if (text == nullptr) return {};
  const config::Config config = config::parse_config(*text, path);
  const auto part = shard == nullptr ? std::nullopt : results::shard_named(*shard);
  return std::to_string(sweep::Share(config.sweep, part).points());
} catch (const config::ConfigError&) {
  return {};
}

/// Counts the points in a process of its own: the text may be anyone's, and its axes may take all memory.
std::string points_told_in_child(const results::FileSummary& summary, const std::string& path) try {
  const std::uint64_t stored = storage::open_input(path, "an output of clatter").stored_bytes;
  return storage::run_in_child([&] { return points_told(summary, path); }, storage::limits_for(stored));
} catch (const storage::ChildFailed& death) {
  results::refuse_damaged(path, death.what());
}

}  // namespace

results::FileSummary read_summary(const std::string& path) {
  results::FileSummary summary = results::read_summary(path);
  const auto status = std::ranges::find(summary.variables, "status", &results::FileSummary::Entry::name);
  if (status == summary.variables.end()) return summary;
  std::size_t points = 1;
  for (const results::NamedLength& dimension : status->dimensions)
    if (dimension.name != "row") points *= dimension.length;  // of `clatter accuracy`
  const std::string told = points_told_in_child(summary, path);
  if (!told.empty() && told != std::to_string(points))
    results::refuse_damaged(path, "its 'status' doesn't have the " + told + " points of its configuration");
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
