#include "config/branch_settings.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

using sweep::Parameter;
using enum sweep::Parameter;

/// Refuses a followed mass or spring beside a damping ratio, or that of a stop beside a damping in N s/m, which would
/// change with it, so that it isn't linear.
void check_damping(const Settings& settings, const Setting& chosen) {
  const std::string& name = std::get<std::string>(chosen.value);
  if (!settings.is_si()) return;
  const auto refuse = [&](const Setting& given, const std::string& in_its_place) {
    fail(given.key_location, "a branch along '" + name + "' beside '" + std::string(given.key->name) +
                                 "', which changes with it; give " + in_its_place);
  };
  if (name == key_of(mass) || name == key_of(stiffness))
    for (const Parameter given : {damping_ratio, quality})
      if (const Setting* const ratio = settings.given(given)) refuse(*ratio, "'damping', in N s/m, in its place");
  if (name == key_of(mass) || name.starts_with(key_of(stop_stiffness)))
    for (const Parameter given : {stop_damping, stop_damping_lower, stop_damping_upper})
      if (const Setting* const damping = settings.given(given);
          damping != nullptr && damping->quantity != Quantity::number)
        refuse(*damping, "it as a damping ratio, without unit");
}

/// The parameter that `along` or `across` names. Throws ConfigError if a value of its interval isn't permitted for it,
/// or [sweep] has an axis of it, too.
Parameter followed_key(const Settings& settings, const Setting& chosen, const Setting* interval) {
  const std::string &name = std::get<std::string>(chosen.value), section(settings.scene_section);
  const Key& key = *find_key(section, name);
  if (interval != nullptr)
    for (const double end : std::get<Interval>(interval->value))
      if (!contains(key.range, end))
        fail(interval->location, std::string(interval->key->name) + " has " + name + " = " + number_text(end) +
                                     "; expected " + permitted(key));
  if (interval != nullptr && interval->quantity != key.quantity)
    fail(interval->location, std::string(interval->key->name) + " of " + name +
                                 ", which is followed as a damping ratio; give it without unit, as damping over "
                                 "2 (stop_stiffness mass)^(1/2)");
  if (name == "xs" && interval != nullptr && std::get<Interval>(interval->value)[0] < 0)
    fail(interval->location, "xs stands for |xs|; expected two numbers above 0");
  for (const Setting& axis : settings.axes)
    if (axis.key->name == name)
      fail(axis.key_location, in_quotes(name)
                                  .append(" in both [sweep] and [branch] ")
                                  .append(chosen.key->name)
                                  .append("; remove it from [sweep], and give the value to begin at in [")
                                  .append(section + ']'));
  check_damping(settings, chosen);
  return sweep::parameter_of(name).value();
}

/// Whether two keys are one, or stand for a number of a stop or of the damper that both change.
bool change_the_same(Parameter one, Parameter other) {
  const auto parts = [](Parameter parameter) {
    if (parameter == xs || parameter == gap) return std::vector{stop_lower, stop_upper};
    if (parameter == R) return std::vector{R_lower, R_upper};
    if (parameter == stop_stiffness) return std::vector{stop_stiffness_lower, stop_stiffness_upper};
    if (parameter == stop_damping) return std::vector{stop_damping_lower, stop_damping_upper};
    if (parameter == damping_ratio || parameter == quality) return std::vector{damping};
    return std::vector{parameter};
  };
  const std::vector<Parameter> first = parts(one), second = parts(other);
  return std::ranges::find_first_of(first, second) != first.end();
}

/// A range as its user gave it, in computed numbers.
std::array<double, 2> computed_range(const branches::Followed& followed, const Interval& users) {
  const auto [low, high] = std::minmax({followed.to_computed(users[0]), followed.to_computed(users[1])});
  return {low, high};
}

/// The second parameter of [branch], if there is one, and the special points that are followed across it.
void add_second_parameter(const Settings& settings, const point::Problem& start, branches::BranchSettings& branch) {
  const Setting *const across = settings.find("branch", "across"), *const curve = settings.find("branch", "curve"),
                       *const range = settings.find("branch", "across_range");
  const std::string example = settings.is_si() ? "across = \"gap\"" : "across = \"xs\"";
  for (const Setting* const of_it : {curve, range})
    if (across == nullptr && of_it != nullptr)
      fail(of_it->key_location,
           in_quotes(of_it->key->name) + " without 'across'; add the second parameter, e.g. " + example);
  if (across == nullptr) return;
  if (curve == nullptr)
    fail(across->location, "'across' without 'curve'; add the special points that are followed, e.g. curve = \"fold\"");
  const Parameter key = followed_key(settings, *across, range);
  branch.across = branches::followed(key, start), branch.curve = settings.text("branch", "curve");
  if (change_the_same(key, branch.along.given))
    fail(across->location, in_quotes(key_of(key)) + " and " + in_quotes(branch.along.name()) +
                               " change the same quantity; expected another key of [" +
                               std::string(settings.scene_section) + ']');
  const AllowedRange& permitted_values = find_key(settings.scene_section, key_of(key))->range;
  const Interval all{permitted_values.not_zero ? 0.0 : permitted_values.low, permitted_values.high};
  branch.across_range =
      computed_range(*branch.across, range != nullptr ? settings.interval("branch", "across_range") : all);
}

}  // namespace

std::optional<branches::BranchSettings> branch_settings_of(const Settings& settings, const point::Problem& start) {
  const Setting *const along = settings.find("branch", "along"), *const range = settings.find("branch", "range");
  const auto asks_for_branch = [](const Setting& setting) {
    const Key& key = *setting.key;
    return key.section == "branch" && (key.fallback.empty() || setting.value != default_setting(key).value);
  };
  if (along == nullptr && std::ranges::none_of(settings.values, asks_for_branch)) return std::nullopt;
  const bool is_si = settings.is_si();
  if (along == nullptr)
    fail(settings.location_of_section("branch"), "[branch] without 'along'; add a key of [" +
                                                     std::string(settings.scene_section) + "], e.g. along = \"" +
                                                     (is_si ? "frequency" : "nu") + '"');
  if (range == nullptr)
    fail(settings.location_of_section("branch"),
         std::string("[branch] without 'range'; add the values to stop at, e.g. range = ") +
             (is_si ? "[\"20 Hz\", \"30 Hz\"]" : "[0.8, 1.5]"));
  branches::BranchSettings branch{.along = branches::followed(followed_key(settings, *along, range), start),
                                  .period = settings.integer("branch", "period"),
                                  .tolerance = settings.number("branch", "tolerance"),
                                  .largest_step = settings.number("branch", "largest_step"),
                                  .max_points = settings.integer("branch", "max_points"),
                                  .generations = settings.integer("branch", "switch")};
  branch.range = computed_range(branch.along, settings.interval("branch", "range"));
  add_second_parameter(settings, start, branch);
  return branch;
}

}  // namespace clatter::config
