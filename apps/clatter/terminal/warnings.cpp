#include "terminal/warnings.hpp"

#include <algorithm>
#include <iostream>

#include "plan/costliest_point.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {

void warn(const config::Config& config, std::span<const std::string_view> ignored) {
  for (const config::Warning& warning : config.warnings) {
    if (std::ranges::find(ignored, warning.section) != ignored.end()) continue;
    std::cerr << storage::printable(warning.location + ": warning: " + warning.text) << '\n';
  }
}

void warn(const plan::Plan& plan) {
  for (const std::string& warning : plan.warnings) std::cerr << "warning: " << storage::printable(warning) << '\n';
}

void warn_of_costliest_point(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard) {
  if (const auto warning = plan::warning_of_costliest_point(sweep, shard)) std::cerr << "warning: " << *warning << '\n';
}

void say_notes(const config::Config& config) {
  for (const std::string& note : config.notes) std::cerr << storage::printable(note) << '\n';
}

void join_warnings(plan::Plan& plan, const config::Config& config) {
  std::vector<std::string> all;
  for (const config::Warning& warning : config.warnings) all.push_back(warning.location + ": " + warning.text);
  plan.warnings.insert(plan.warnings.begin(), all.begin(), all.end());
}

}  // namespace clatter::app
