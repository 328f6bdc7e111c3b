#include "branch_start.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "common_options.hpp"
#include "config/keys.hpp"
#include "config/suggestion.hpp"
#include "config/unit.hpp"
#include "config/value_grammar.hpp"
#include "outputs/output_summary.hpp"
#include "point_of_output.hpp"
#include "storage/utf8.hpp"
#include "table_options.hpp"

namespace clatter::app {
namespace {

/// The first parameter, but for those of the start, in which two scenes differ; nothing: they are the same.
std::optional<Parameter> difference(const GivenScene& one, const GivenScene& other) {
  for (const Parameter parameter : all_parameters) {
    const bool is_told_by_others = parameter.is_of_both() || parameter.role() == Role::start;
    if (!is_told_by_others && value_of(one, parameter) != value_of(other, parameter)) return parameter;
  }
  return std::nullopt;
}

std::string section_of(const GivenScene& scene) { return scene.is_si ? "machine" : "scene"; }

/// "1.2", "5 N s/m": as --set would give it.
std::string written(Parameter parameter, double value) {
  const auto& row = parameter.row();
  return config::number_text(value) +
         (row.is_with_unit ? ' ' + std::string(config::unit_of_numbers(row.quantity)) : "");
}

bool is_swept(const config::Config& config, Parameter parameter) {
  return std::ranges::any_of(config.sweep.dimensions, [&](const sweep::Dimension& dimension) {
    return std::ranges::find(dimension, parameter.key(),
                             [](const sweep::Axis& axis) { return axis.parameter.key(); }) != dimension.end();
  });
}

/// Whether one of the parameters sets a number of the scene that another one sets, too.
bool is_among(const std::vector<Parameter>& parameters, Parameter one) {
  return std::ranges::any_of(parameters, [&](Parameter other) {
    return other.key() == one.key() || other.stands_for(one) || one.stands_for(other) ||
           (other.role() == Role::damping && one.role() == Role::damping);
  });
}

/// What the point gives: the parameters that the output varies, and those that the branch is followed along.
std::vector<Parameter> parameters_of(const PointOfOutput& point, const branches::BranchSettings& branch) {
  std::vector<Parameter> parameters;
  for (const Parameter parameter : point.varied)
    if (parameter.role() != Role::start) parameters.push_back(parameter);
  if (!is_among(parameters, branch.along)) parameters.push_back(branch.along);
  if (branch.across && !is_among(parameters, *branch.across)) parameters.push_back(*branch.across);
  return parameters;
}

/// The settings that make a configuration start at a point.
std::vector<config::Override> changes_for(const PointOfOutput& point, const config::Config& config) {
  const std::string section = section_of(point.scene) + '.';
  std::vector<config::Override> changes;
  for (const Parameter parameter : parameters_of(point, *config.branch)) {
    const double value = value_of(point.scene, parameter);
    GivenScene changed = config.sweep.problem;
    set(changed, parameter, value);
    if (is_swept(config, parameter) || difference(changed, config.sweep.problem))
      changes.push_back({section + std::string(parameter.key()), written(parameter, value)});
  }
  const Start& start = point.scene.start;
  changes.push_back({section + "x0", config::number_text(start.displacement)});
  changes.push_back({section + "v0", config::number_text(start.velocity)});
  changes.push_back({section + "phase", config::number_text(start.phase)});
  changes.push_back({"branch.period", std::to_string(point.periods)});
  if (!config.sweep.dimensions.empty())
    for (const char* const names : {"sweep.linked", "sweep.follow"}) changes.push_back({names, ""});
  return changes;
}

/// Throws UsageError if the motion of a point isn't one of the configuration's scene.
void require_same_scene(const PointOfOutput& point, const GivenScene& scene, const std::string& file,
                        const std::string& from) {
  const std::optional<Parameter> parameter = difference(scene, point.scene);
  if (!parameter) return;
  const std::string key = section_of(scene) + '.' + std::string(parameter->key()),
                    own = written(*parameter, value_of(scene, *parameter)),
                    there = written(*parameter, value_of(point.scene, *parameter));
  throw UsageError(storage::printable(file) + ": " + key + " is " + own + ", and in " + storage::quoted_name(from) +
                   " it is " + there + ", so the motion is of another scene; add --set " + key + "='" + there +
                   "', or name an output of this scene");
}

void require_period(const PointOfOutput& point, const std::string& from) {
  const Key& key = *config::find_key("branch", "period");
  if (config::contains(key.range, static_cast<double>(point.periods))) return;
  throw UsageError(storage::quoted_name(from) + " at " + point.name + " has motion of " +
                   std::to_string(point.periods) + " forcing periods; expected at most " +
                   config::number_text(key.range.high));
}

config::Config config_of_file(const std::string& path, const std::vector<config::Override>& changes) {
  return config::parse_config(outputs::config_of_output(outputs::read_summary(path), path).text, path, changes);
}

void require_branch(const config::Config& config, const std::string& file) {
  if (config.branch) return;
  throw UsageError(storage::printable(file) + ": no branch.along and branch.range; say what to follow, e.g. --set " +
                   (config.sweep.problem.is_si ? "branch.along=frequency --set branch.range='20 Hz, 30 Hz'"
                                               : "branch.along=nu --set branch.range='0.8, 1.5'"));
}

void require_no_sweep(const config::Config& config, const std::string& file) {
  if (config.sweep.dimensions.empty()) return;
  throw UsageError(storage::printable(file) + ": [sweep] has the axis " +
                   std::string(config.sweep.dimensions[0][0].parameter.key()) +
                   ", and a branch is followed at one value of it; give that in [" + section_of(config.sweep.problem) +
                   ']');
}

}  // namespace

BranchStart branch_start_of(const Arguments& arguments) {
  const std::optional<std::string> from = arguments.value("from");
  if (!from && arguments.has("where"))
    throw UsageError("--where chooses the point of an output that a branch starts from; name that with --from FILE.h5");
  if (!from && arguments.operands.empty())
    throw UsageError("CONFIG is missing; write: clatter branch CONFIG, or clatter branch --from FILE.h5");
  const bool has_config = !arguments.operands.empty();
  BranchStart begun{has_config ? config_of(arguments) : config_of_file(*from, overrides_of(arguments)),
                    has_config ? arguments.operands[0] : *from,
                    {}};
  require_branch(begun.config, begun.file);
  if (from) {
    const PointOfOutput point = point_of_output(*from, places_of(arguments));
    if (point.scene.is_si != begun.config.sweep.problem.is_si)
      throw UsageError(storage::printable(begun.file) + " describes its scene in [" +
                       section_of(begun.config.sweep.problem) + "], and " + storage::quoted_name(*from) + " in [" +
                       section_of(point.scene) + "]; name an output of this scene");
    require_period(point, *from);
    begun.config = config::parse_config(begun.config.text, begun.file, changes_for(point, begun.config));
    require_same_scene(point, begun.config.sweep.problem, begun.file, *from);
    begun.note = "starts from " + storage::quoted_name(*from) + (point.name.empty() ? "" : " at " + point.name) +
                 ", period " + std::to_string(point.periods);
  }
  require_no_sweep(begun.config, begun.file);
  return begun;
}

}  // namespace clatter::app
