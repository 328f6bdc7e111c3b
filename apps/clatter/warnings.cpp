#include "warnings.hpp"

#include <algorithm>
#include <iostream>

#include "storage/utf8.hpp"
#include "sweep/dearest_point.hpp"

namespace clatter {

void warn(const Config& config, std::span<const std::string_view> but) {
  for (const Warning& warning : config.warnings) {
    if (std::ranges::find(but, warning.section) != but.end()) continue;
    std::cerr << printable(warning.place + ": warning: " + warning.text) << '\n';
  }
}

void warn(const Plan& plan) {
  for (const std::string& warning : plan.warnings) std::cerr << "warning: " << printable(warning) << '\n';
}

void warn_of_dearest_point(const Sweep& sweep, const std::optional<Shard>& shard) {
  if (const auto warning = warning_of_dearest_point(sweep, shard)) std::cerr << "warning: " << *warning << '\n';
}

void say_notes(const Config& config) {
  for (const std::string& note : config.notes) std::cerr << printable(note) << '\n';
}

void join_warnings(Plan& plan, const Config& config) {
  std::vector<std::string> all;
  for (const Warning& warning : config.warnings) all.push_back(warning.place + ": " + warning.text);
  plan.warnings.insert(plan.warnings.begin(), all.begin(), all.end());
}

}  // namespace clatter
