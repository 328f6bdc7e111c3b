#include "runs/branch_start.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "config/keys.hpp"
#include "config/suggestion.hpp"
#include "config/unit.hpp"
#include "config/value_grammar.hpp"
#include "outputs/output_summary.hpp"
#include "runs/point_of_output.hpp"
#include "storage/utf8.hpp"
#include "terminal/common_options.hpp"
#include "terminal/table_options.hpp"

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

/// Whether one of the parameters sets a number of the scene that another one sets, too.
bool is_among(const std::vector<Parameter>& parameters, Parameter one) {
  return std::ranges::any_of(parameters, [&](Parameter other) {
    return other.key() == one.key() || other.stands_for(one) || one.stands_for(other) ||
           (other.role() == Role::damping && one.role() == Role::damping);
  });
}

/// Settings of a configuration that --from gives.
class FromPoint {
 public:
  FromPoint(const PointOfOutput& point, const std::string& path)
      : point_(point), option_("--from " + storage::quoted_name(path)) {}

  /// What the output varies, in place of axes.
  [[nodiscard]] std::vector<config::Override> varied() const {
    std::vector<config::Override> changes{{"sweep.linked", "", option_}, {"sweep.follow", "", option_}};
    for (const Parameter parameter : point_.varied) changes.push_back(setting(parameter));
    return changes;
  }
  /// The start of its motion, and the parameters that a branch is followed along.
  [[nodiscard]] std::vector<config::Override> start(const GivenScene& scene,
                                                    const branches::BranchSettings& branch) const {
    std::vector<config::Override> changes;
    for (const std::optional<Parameter> parameter : {std::optional(branch.along), branch.across}) {
      if (!parameter || is_among(point_.varied, *parameter)) continue;
      GivenScene changed = scene;
      set(changed, *parameter, value_of(point_.scene, *parameter));
      if (difference(changed, scene)) changes.push_back(setting(*parameter));
    }
    const Start& start = point_.scene.start;
    for (const auto& [key, value] :
         {std::pair("x0", start.displacement), {"v0", start.velocity}, {"phase", start.phase}})
      changes.push_back({section() + key, config::number_text(value), option_});
    if (const LooseMass& loose = point_.scene.loose; has_loose_mass(loose))
      for (const auto& [key, value] : {std::pair("loose_x0", loose.place), {"loose_v0", loose.velocity}})
        changes.push_back({section() + key, config::number_text(value), option_});
    changes.push_back({"branch.period", std::to_string(point_.periods), option_});
    return changes;
  }

 private:
  [[nodiscard]] std::string section() const { return section_of(point_.scene) + '.'; }
  [[nodiscard]] config::Override setting(Parameter parameter) const {
    return {section() + std::string(parameter.key()), written(parameter, value_of(point_.scene, parameter)), option_};
  }

  const PointOfOutput& point_;
  std::string option_;
};

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

/// The configuration of the first operand, or without one that of --from, changed by --set and then by `changes`.
config::Config read(const Arguments& arguments, const std::vector<config::Override>& changes) {
  if (!arguments.operands.empty()) return config_of(arguments, changes);
  const std::string path = arguments.value("from").value();
  std::vector<config::Override> all = overrides_of(arguments);
  all.insert(all.end(), changes.begin(), changes.end());
  return config::parse_config(outputs::config_of_output(outputs::read_summary(path), path).text, path, all);
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

BranchStart from_scene(const Arguments& arguments) {
  if (arguments.has("where"))
    throw UsageError("--where chooses the point of an output that a branch starts from; name that with --from FILE.h5");
  if (arguments.operands.empty())
    throw UsageError("CONFIG is missing; write: clatter branch CONFIG, or clatter branch --from FILE.h5");
  BranchStart begun{config_of(arguments), arguments.operands[0], {}};
  require_branch(begun.config, begun.file), require_no_sweep(begun.config, begun.file);
  return begun;
}

}  // namespace

BranchStart branch_start_of(const Arguments& arguments) {
  const std::optional<std::string> from = arguments.value("from");
  if (!from) return from_scene(arguments);
  const PointOfOutput point = point_of_output(*from, conditions_of(arguments));
  require_period(point, *from);
  const FromPoint changes(point, *from);
  BranchStart begun{read(arguments, changes.varied()), arguments.operands.empty() ? *from : arguments.operands[0],
                    "starts from " + storage::quoted_name(*from) + (point.name.empty() ? "" : " at " + point.name) +
                        ", period " + std::to_string(point.periods)};
  require_branch(begun.config, begun.file);
  begun.config = config::parse_config(begun.config.text, begun.file,
                                      changes.start(begun.config.sweep.problem, *begun.config.branch));
  require_same_scene(point, begun.config.sweep.problem, begun.file, *from);
  require_no_sweep(begun.config, begun.file);
  return begun;
}

}  // namespace clatter::app
