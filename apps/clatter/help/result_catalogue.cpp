#include "help/result_catalogue.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <variant>

#include "accuracy/accuracy_dataset.hpp"
#include "branches/branch_dataset.hpp"
#include "config/config.hpp"
#include "config/config_text.hpp"
#include "scene/parameter.hpp"
#include "sweep/result_dataset.hpp"
#include "tables/csv_text.hpp"
#include "tables/file_points.hpp"
#include "tables/result_names.hpp"

namespace clatter::app {
namespace {

/// A scene that has everything that brings variables of its own: a force, soft stops, friction, shaking; over a
/// parameter and a start.
constexpr std::string_view in_scene =
    "[scene]\nf = 1\nxs = 1\nstop_stiffness = 9\nfriction = 0.1\nbase_amplitude = 0.1\n\n"
    "[sweep]\nnu = [1, 2]\nx0 = [0]\n\n[observe]\n";
constexpr std::string_view in_machine =
    "[machine]\nmass = 1\nstiffness = 1\nforce = 1\ngap = 1\nstop_stiffness = 9\nfriction = 0.1\nbase_amplitude = "
    "0.1\n\n"
    "[sweep]\nfrequency = [1, 2]\nx0 = [0]\n\n[observe]\n";

/// A configuration with every observable, by the example of its key, and what a loose mass adds to them.
config::Config config_with_all(std::string_view scene) {
  std::string text(scene);
  for (const Key& key : config::keys())
    if (key.section == "observe")
      text += std::string(key.name) + " = " + config::toml_value(config::example_setting(key)) + '\n';
  config::Config config = config::parse_config(text, "results");
  auto& observe = config.sweep.problem.observe;
  observe.loose_extrema = observe.loose_harmonics = observe.loose_trajectory = observe.loose_section =
      observe.loose_stability = observe.loose_attractor = observe.loose_sensitivity = observe.wall_impacts =
          observe.of_soft_walls = observe.wall_energy = true;
  config.sweep.follow = 0, config.sweep.direction = sweep::Direction::both;
  return config;
}

results::Dataset described(std::string_view command, const config::Config& config) {
  const sweep::Sweep& sweep = config.sweep;
  if (command == "run") return sweep::description(sweep);
  if (command == "branch")
    return branches::branch_dataset({}, {.along = sweep.dimensions[0][0].parameter}, {.is_si = sweep.problem.is_si},
                                    has_loose_mass(sweep));
  std::vector<accuracy::PointAccuracy> points(size(sweep));
  return accuracy::accuracy_dataset(sweep, points);
}

std::string type_of(const results::ValueArray& values) {
  constexpr std::array names{"float64", "uint8", "int8", "int32", "int64", "string"};
  return names[values.index()];
}

/// "the axes and stop", "impact", "the axes of parameters, and motion"
std::string dimensions_in_words(const std::vector<std::string>& dimensions, const sweep::Sweep& sweep) {
  std::vector<std::string_view> others;
  std::size_t axes = 0;
  for (const std::string& name : dimensions)
    if (Parameter::of(name) || name == "direction")
      ++axes;
    else
      others.push_back(name);
  const bool has_all = axes == sweep.dimensions.size() + 1;
  std::string words = has_all ? "the axes" : axes > 0 ? "the axes but x0, v0, phase and start_period" : "";
  for (const std::string_view other : others) (words += words.empty() ? "" : has_all ? " and " : ", and ") += other;
  return words;
}

std::string attribute_of(const results::Variable& variable, std::string_view name) {
  for (const auto& [key, value] : variable.attributes)
    if (const auto* const text = std::get_if<std::string>(&value); text != nullptr && key == name) return *text;
  return {};
}

/// A variable of a file of a [scene], and the same one of a [machine].
CataloguedResult catalogued(std::string_view command, const results::Variable& variable, const results::Variable& in_si,
                            const sweep::Sweep& sweep) {
  CataloguedResult result{.command = command,
                          .name = variable.name,
                          .type = type_of(variable.values),
                          .over = dimensions_in_words(variable.dimensions, sweep),
                          .meaning = variable.long_name,
                          .meaning_in_si = in_si.long_name,
                          .units = variable.units,
                          .units_in_si = in_si.units,
                          .frame = attribute_of(variable, "frame"),
                          .observable = attribute_of(variable, "observable"),
                          .missing_if = variable.missing_if};
  if (result.frame == "absolute") result.frame = "observed";  // it was asked for
  const std::vector<std::string> words = meanings_of(variable);
  for (std::size_t value = 0; value < words.size(); ++value)
    if (!words[value].empty()) result.flags.emplace_back(static_cast<std::uint8_t>(value), words[value]);
  return result;
}

std::vector<CataloguedResult> catalogue() {
  const config::Config scene = config_with_all(in_scene), machine = config_with_all(in_machine);
  std::vector<CataloguedResult> all;
  for (const std::string_view command : {"run", "branch", "accuracy"}) {
    const results::Dataset dataset = described(command, scene), in_si = described(command, machine);
    for (const results::Variable& variable : dataset.variables) {
      const auto same = std::ranges::find(in_si.variables, variable.name, &results::Variable::name);
      std::string_view own = variable.name;
      if (command == "branch" && own.starts_with(special_prefix)) own.remove_prefix(special_prefix.size());
      const bool is_again = command == "accuracy" && own == "direction";
      if (same != in_si.variables.end() && !Parameter::of(own) && !is_again)
        all.push_back(catalogued(command, variable, *same, scene.sweep));
    }
  }
  return all;
}

/// Of a derivative by any key that sensitivities take, as d_x_max_d_gap; the catalogue has those by one of them.
std::optional<CataloguedResult> derivative_named(std::string_view name) {
  constexpr std::string_view by = "_d_";
  const std::size_t at = name.rfind(by);
  if (!name.starts_with("d_") || at == std::string_view::npos) return std::nullopt;
  const std::optional<Parameter> key = Parameter::of(name.substr(at + by.size()));
  if (!key || key->role() == Role::start) return std::nullopt;
  config::Config scene = config_with_all(in_scene), machine = config_with_all(in_machine);
  for (config::Config* const config : {&scene, &machine}) {
    config->sweep.problem.observe.sensitivity = {};
    config->sweep.problem.observe.sensitivity.insert(*key);
  }
  const results::Dataset dataset = described("run", scene), in_si = described("run", machine);
  const auto own = std::ranges::find(dataset.variables, name, &results::Variable::name);
  const auto same = std::ranges::find(in_si.variables, name, &results::Variable::name);
  if (own == dataset.variables.end() || same == in_si.variables.end()) return std::nullopt;
  return catalogued("run", *own, key->is_in("machine") ? *same : *own, scene.sweep);
}

}  // namespace

std::span<const CataloguedResult> result_catalogue() {
  static const std::vector<CataloguedResult> all = catalogue();
  return all;
}

std::vector<const CataloguedResult*> results_named(std::string_view name) {
  std::vector<const CataloguedResult*> named;
  const auto is_meant = [&](const CataloguedResult& result) {
    return result.name == name || (result.command != "accuracy" && typed_name(result.name, result.over) == name);
  };
  for (const CataloguedResult& result : result_catalogue())
    if (is_meant(result)) named.push_back(&result);
  std::stable_partition(named.begin(), named.end(),
                        [&](const CataloguedResult* result) { return result->name == name; });
  if (!named.empty()) return named;
  static std::map<std::string, std::optional<CataloguedResult>, std::less<>> derivatives;
  const auto known = derivatives.try_emplace(std::string(name), derivative_named(name)).first;
  if (known->second) named.push_back(&*known->second);
  return named;
}

std::string_view command_of(const results::FileSummary& summary) {
  if (holds_accuracy(summary)) return "accuracy";
  return holds_branches(summary) ? "branch" : "run";
}

}  // namespace clatter::app
