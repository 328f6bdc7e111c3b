#include "config/branch_settings.hpp"

#include <algorithm>
#include <string>

#include "config/suggestion.hpp"
#include "config/unit.hpp"

namespace clatter::config {
namespace {

/// The quantity in which the scene gives a key, or one that stands for it; nothing if none is given.
std::optional<Quantity> quantity_given(const Settings& settings, Parameter key) {
  for (const Parameter other : all_parameters)
    if (const bool is_its = other.key() == key.key() || other.stands_for(key) || key.stands_for(other); is_its)
      if (const Setting* const given = settings.given(other)) return given->quantity;
  return std::nullopt;
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
  if (name == "xs" && interval != nullptr && std::get<Interval>(interval->value)[0] < 0)
    fail(interval->location, "xs stands for |xs|; expected two numbers above 0");
  for (const Setting& axis : settings.axes)
    if (axis.key->name == name)
      fail(axis.key_location, in_quotes(name)
                                  .append(" in both [sweep] and [branch] ")
                                  .append(chosen.key->name)
                                  .append("; remove it from [sweep], and give the value to begin at in [")
                                  .append(section + ']'));
  const Parameter parameter = Parameter::of(name).value();
  const Quantity written = interval != nullptr ? interval->quantity : key.quantity,
                 quantity = quantity_given(settings, parameter).value_or(written);
  if (interval != nullptr && written != quantity && key.with_unit != Quantity::number)
    fail(interval->location, std::string(interval->key->name) + " of " + name + " is " + description_of(written) +
                                 ", and [" + section + "] gives it as " + description_of(quantity) +
                                 "; give both in one way");
  return Parameter::of(name, key.with_unit != Quantity::number ? quantity : key.quantity).value();
}

/// Whether two keys are one, or stand for a number of a stop or of the damper that both change.
bool change_the_same(Parameter one, Parameter other) {
  const bool of_damper = one.role() == Role::damping && other.role() == Role::damping;
  return one.key() == other.key() || one.stands_for(other) || other.stands_for(one) || of_damper;
}

/// The second parameter of [branch], if there is one, and the special points that are followed across it.
void add_second_parameter(const Settings& settings, branches::BranchSettings& branch) {
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
  branch.across = key, branch.curve = settings.text("branch", "curve");
  if (change_the_same(key, branch.along))
    fail(across->location, in_quotes(key.key()) + " and " + in_quotes(branch.along.key()) +
                               " change the same quantity; expected another key of [" +
                               std::string(settings.scene_section) + ']');
  const AllowedRange& permitted_values = find_key(settings.scene_section, key.key())->range;
  const Interval all{permitted_values.not_zero ? 0.0 : permitted_values.low, permitted_values.high};
  branch.across_range = range != nullptr ? settings.interval("branch", "across_range") : all;
}

}  // namespace

std::optional<branches::BranchSettings> branch_settings_of(const Settings& settings) {
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
  branches::BranchSettings branch{.along = followed_key(settings, *along, range),
                                  .range = settings.interval("branch", "range"),
                                  .period = settings.integer("branch", "period"),
                                  .tolerance = settings.number("branch", "tolerance"),
                                  .largest_step = settings.number("branch", "largest_step"),
                                  .max_points = settings.integer("branch", "max_points"),
                                  .generations = settings.integer("branch", "switch")};
  add_second_parameter(settings, branch);
  return branch;
}

}  // namespace clatter::config
