#include "tables/result_names.hpp"

#include <vector>

#include "tables/file_points.hpp"

namespace clatter::app {

std::string name_in_file(const results::FileSummary& summary, const std::string& typed, std::string_view prefix) {
  const ComponentName name(typed);
  const std::string rest = typed.substr(name.variable.size());
  std::vector<std::string> own{name.variable};
  for (const auto& [of_sweeps, ours] : names_of_sweeps)
    if (name.variable == of_sweeps || name.variable == ours) own.emplace_back(of_sweeps), own.emplace_back(ours);
  std::vector<std::string> candidates;
  for (const std::string& one : own) {
    if (!prefix.empty()) candidates.push_back(std::string(prefix) + one);
    candidates.push_back(one);
  }
  if (find_variable(summary, "attractor") != nullptr)  // of the motion that a point ends in
    for (const std::string& one : own) candidates.push_back(std::string(motion_prefix) + one);
  for (const std::string& candidate : candidates)
    if (find_variable(summary, candidate) != nullptr) return candidate + rest;
  return typed;
}

std::string typed_name(std::string_view variable, std::string_view over) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> prefixes{
      {{special_prefix, special_points}, {motion_prefix, ended_motions}, {impact_prefix, logged_impacts}}};
  for (const auto& [prefix, dimension] : prefixes)
    if (variable.starts_with(prefix) && over.find(dimension) != std::string_view::npos)
      return std::string(variable.substr(prefix.size()));
  for (const auto& [of_sweeps, ours] : names_of_sweeps)
    if (variable == of_sweeps) return std::string(ours);
  return std::string(variable);
}

}  // namespace clatter::app
