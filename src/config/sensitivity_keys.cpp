#include <algorithm>
#include <string>

#include "config/consistency.hpp"
#include "config/force_shape.hpp"
#include "config/force_table.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"

namespace clatter::config {
namespace {

/// Whether a key is one of a machine with a loose mass, of whose main mass stops and friction are its own, and which
/// may rub on its housing. Nothing shakes these.
bool is_of_housed(const Settings& settings, Parameter parameter) {
  if (parameter.is_loose() && parameter.role() == Role::friction) return has_loose_friction(settings);
  if (!has_main_events(settings)) return !conflicts_with_loose_mass(parameter);
  if (parameter.role() == Role::friction) return has_friction_somewhere(settings);
  return parameter != "stop_amplitude" && parameter != "base_amplitude";
}

/// The keys by which steady motion has derivatives.
std::vector<std::string_view> keys_of_motion(const Settings& settings) {
  std::vector<std::string_view> names;
  const bool is_housed = has_loose_mass(settings);
  for (const Parameter parameter : all_parameters) {
    const bool is_its = is_housed ? is_of_housed(settings, parameter) : !parameter.is_loose();
    if (parameter.is_in(settings.scene_section) && parameter.role() != Role::start &&
        parameter.role() != Role::stop_motion && is_its && !parameter.row().is_with_unit)
      names.push_back(parameter.key());
  }
  return names;
}

/// Throws ConfigError if a name is no such key.
void check_name(const Settings& settings, const Setting& names, const std::string& name) {
  const std::string section(settings.scene_section), message = names_key(names, name);
  const std::vector<std::string_view> known = keys_of_motion(settings);
  if (std::ranges::find(known, name) != known.end()) return;
  const std::optional<Parameter> parameter = Parameter::of(name);
  if (parameter && parameter->role() == Role::start)
    fail(names.location, message + ", a start, which steady motion doesn't depend on; leave it out");
  if (parameter && has_loose_mass(settings) && !is_of_housed(settings, *parameter))
    fail(names.location, message + ", which conflicts with 'loose_mass'; leave it out");
  if (parameter && !counterpart_of(name).empty())
    fail(names.location, message + ", no key of [" + section + "], which describes this scene; take " +
                             in_quotes(counterpart_of(name)));
  if (parameter && parameter->is_loose())
    fail(names.location, message + " without 'loose_mass'; give that, or leave it out");
  fail(names.location,
       message + ", which is no key of [" + section + ']' + suggestion(name, known, "; the keys are: "));
}

/// Throws ConfigError if a key has no value that could change, since others give what it would.
void check_given(const Settings& settings, const Setting& names, Parameter key) {
  const std::string message = names_key(names, key.key());
  const bool is_distance = key.is_of_both() && key.role() == Role::position;
  if (is_distance && settings.given(key) == nullptr)
    fail(names.location,
         message + (key.is_loose() ? ", and the walls are given one by one; name 'loose_lower' or 'loose_upper'"
                                   : ", and the stops are given one by one; name 'stop_lower' or 'stop_upper'"));
  const Waveform waveform = waveform_of(settings);
  if ((key == "f" || key == "force") && has_force_table(settings))
    fail(names.location, message + ", and the force is given by 'force_table'; name 'force_factor'");
  if (key.role() == Role::shaking && has_force_in_pieces(settings))
    fail(names.location,
         message + ", and what is shaken moves as a sine, so far beside a force of sines; leave it out");
  if ((key == "force_factor" && !has_force_table(settings)) || (key == "force_duty" && !has_duty(waveform)) ||
      (key == "force_rise" && waveform != Waveform::trapezoid) ||
      (key.role() == Role::force_order && settings.given(amplitude_of_order(key, settings.is_si())) == nullptr))
    fail(names.location, message + ", which this force doesn't have; leave it out");
  if (key == "quality" && !quantity_given(settings, key))
    fail(names.location, message + ", and the damping isn't given by it; name 'damping' or 'damping_ratio'");
  for (const std::string kinetic : {"friction", "loose_friction"})
    if (key.key() == kinetic + "_static" && settings.given(key) == nullptr)
      fail(names.location,
           message + ", which isn't given, so that it follows " + in_quotes(kinetic) + "; name that, or give it");
  const Setting* const moved = settings.given("stop_amplitude");
  if (key.role() == Role::friction && moved != nullptr &&
      std::ranges::any_of(moved->numbers(), [](double amplitude) { return amplitude != 0; }))
    fail(names.location, message + ", which conflicts with 'stop_amplitude'; leave it out");
  const bool is_of_collision = key.role() == Role::stop_damping && key.key().find("_R") != std::string_view::npos;
  if (is_of_collision && !quantity_given(settings, key))
    fail(names.location, message + ", and the damping of the " + (key.is_loose() ? "wall" : "stop") +
                             " isn't given by it; name '" + (key.is_loose() ? "loose_wall" : "stop") + "_damping'");
}

}  // namespace

std::string names_key(const Setting& setting, std::string_view name) {
  return std::string(setting.key->name) + " names " + in_quotes(name);
}

std::optional<Quantity> quantity_given(const Settings& settings, Parameter key) {
  for (const Parameter other : all_parameters)
    if (const bool is_its = other.key() == key.key() || other.stands_for(key) || key.stands_for(other); is_its)
      if (const Setting* const given = settings.given(other)) return given->quantity;
  return std::nullopt;
}

ParameterSet named_parameters(const Settings& settings, std::string_view section, std::string_view name) {
  const Setting* const names = settings.find(section, name);
  ParameterSet parameters;
  if (names == nullptr || without_blanks(std::get<std::string>(names->value)).empty()) return parameters;
  for (const std::string& key : split_names(std::get<std::string>(names->value))) {
    check_name(settings, *names, key);
    const Quantity written = quantity_given(settings, Parameter::of(key).value()).value_or(Quantity::number);
    const Parameter parameter = Parameter::of(key, written).value();
    if (parameters.contains(parameter)) fail(names->location, names_key(*names, key) + " twice; name each key once");
    check_given(settings, *names, parameter);
    parameters.insert(parameter);
  }
  return parameters;
}

void check_sensitivity(const Settings& settings) {
  const Setting* const names = settings.find("observe", "sensitivity");
  if (named_parameters(settings, "observe", "sensitivity").empty()) return;
  if (settings.text("time", "mode") == "transient")
    fail(names->location,
         "sensitivity of a transient; only steady motion has one: remove the key, or mode = \"transient\"");
  if (const std::string method = settings.text("integrator", "method"); method != "exact")
    fail(names->location, "sensitivity by method = " + in_quotes(method) + "; only 'exact' computes it");
}

}  // namespace clatter::config
