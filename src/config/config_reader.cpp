#include <algorithm>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "config/config.hpp"
#include "config/config_text.hpp"
#include "config/consistency.hpp"
#include "config/force_shape.hpp"
#include "config/force_table.hpp"
#include "config/parsed_config.hpp"
#include "config/restitution.hpp"
#include "config/settings.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "config/unit.hpp"
#include "observables/all.hpp"

namespace clatter::config {
namespace {

ParsedConfig read_parsed(const std::string& path, Format format) {
  const bool from_file = path != standard_input;
  const std::string name = from_file ? path : "stdin";
  const std::string text = from_file ? read_text(path) : read_standard_input(name);
  const bool ini = format == Format::ini || has_ending(path, ".ini");
  return ini ? read_ini(name, text) : read_toml(name, text);
}

steady::TimeSettings time_settings(const Settings& settings) {
  return {.mode = settings.text("time", "mode") == "transient" ? steady::Mode::transient : steady::Mode::steady,
          .max_periods = settings.integer("time", "max_periods"),
          .window = settings.integer("time", "window"),
          .duration = settings.number("time", "duration"),
          .tolerance = settings.number("time", "tolerance"),
          .max_impacts = static_cast<double>(settings.integer("time", "max_impacts"))};
}

sweep::Direction direction_of(const Settings& settings) {
  const auto chosen = std::ranges::find(sweep::direction_names, settings.text("sweep", "direction"));
  return static_cast<sweep::Direction>(chosen - sweep::direction_names.begin());
}

/// Reads a key into the field that it sets; an enumeration by the index of the choice.
template <class Object, class T>
void read(const Settings& settings, const observables::Field<Object, T>& field, Object& object) {
  const auto& [section, name] = std::pair{field.key.section, field.key.name};
  if constexpr (std::is_same_v<T, bool>) {
    object.*field.member = settings.flag(section, name);
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    object.*field.member = settings.integer(section, name);
  } else if constexpr (std::is_same_v<T, double>) {
    object.*field.member = settings.number(section, name);
  } else if constexpr (std::is_same_v<T, ParameterSet>) {
    object.*field.member = named_parameters(settings, section, name);
  } else {
    static_assert(std::is_enum_v<T>);
    const auto chosen = std::ranges::find(field.key.choices, settings.text(section, name));
    object.*field.member = static_cast<T>(chosen - field.key.choices.begin());
  }
}

observables::Observe observe(const Settings& settings) {
  observables::Observe observe;
  observables::All::each([&]<class O>() {
    typename O::Settings& of_observable = observe;
    std::apply([&](const auto&... field) { (read(settings, field, of_observable), ...); }, O::fields);
  });
  observe.frame = settings.text("observe", "frame") == "absolute" ? Frame::absolute : Frame::relative;
  return observe;
}

stepping::Method method(const std::string& name) {
  return static_cast<stepping::Method>(std::ranges::find(stepping::method_names, name) -
                                       stepping::method_names.begin());
}

stepping::Integration integration(const Settings& settings) {
  return {.method = method(settings.text("integrator", "method")),
          .tolerance = settings.number("integrator", "tolerance"),
          .step = settings.number("integrator", "step"),
          .theta = settings.number("integrator", "theta"),
          .all_effects = settings.text("integrator", "effects") == "all"};
}

/// The parameter that a setting of the scene gives.
Parameter parameter_of(const Setting& given) { return Parameter::of(given.key->name, given.quantity).value(); }

/// The scene before any axis is applied; a key that isn't given keeps its neutral value.
sweep::GivenProblem given_problem(const Settings& settings) {
  sweep::GivenProblem problem;
  problem.time = time_settings(settings);
  problem.observe = observe(settings);
  problem.integration = integration(settings);
  problem.is_si = settings.is_si();
  if (problem.is_si) problem.oscillator.stiffness = problem.oscillator.frequency = 0;  // none without a key
  for (const Setting& given : settings.values)
    if (const double* const value = std::get_if<double>(&given.value);
        value != nullptr && given.key->section == settings.scene_section)
      set(problem, parameter_of(given), *value);
  set_speed_tables(settings, problem), set_force_shape(settings, problem);
  return problem;
}

sweep::Sweep sweep_of(Settings& settings, const AxisGroups& groups) {
  sweep::Sweep sweep{.problem = given_problem(settings), .follow = followed_dimension(settings, groups)};
  sweep.problem.observe.of_soft_stops =
      is_soft_somewhere(settings, Side::lower) || is_soft_somewhere(settings, Side::upper);
  auto& observed = sweep.problem.observe;
  observed.loose_extrema = observed.loose_harmonics = observed.loose_impacts = observed.loose_trajectory =
      observed.loose_section = observed.loose_stability = observed.loose_attractor = observed.loose_sensitivity =
          has_loose_mass(settings);
  if (has_loose_mass(settings) && has_main_events(settings)) {
    observed.loose_impacts = false;
    observed.wall_impacts = observed.wall_energy = observed.wall_log = observed.word_walls = true;
  }
  const bool has_soft_walls =
      is_soft_wall_somewhere(settings, Side::lower) || is_soft_wall_somewhere(settings, Side::upper);
  if (has_soft_walls) (observed.wall_impacts ? observed.of_soft_walls : observed.of_soft_stops) = true;
  observed.of_sticks = has_friction_somewhere(settings);
  observed.of_friction = observed.of_sticks || has_loose_friction(settings);
  if (sweep.follow) sweep.direction = direction_of(settings), observed.followed_attractor = true;
  for (const std::vector<std::size_t>& group : groups) {
    sweep::Dimension& dimension = sweep.dimensions.emplace_back();
    for (const std::size_t axis : group) {
      Setting& setting = settings.axes[axis];
      AxisValues& axis_values = std::get<AxisValues>(setting.value);
      dimension.push_back({parameter_of(setting), std::move(axis_values.values), axis_values.sobol.has_value()});
    }
  }
  return sweep;
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

/// Whether two keys are one, or stand for a number of a stop or of a damper that both change.
bool change_the_same(Parameter one, Parameter other) {
  const bool is_damping = one.role() == Role::damping || one.role() == Role::stop_damping;
  const bool of_one_stop = one.side() == other.side() || one.is_of_both() || other.is_of_both();
  const bool of_one_damper =
      is_damping && one.role() == other.role() && of_one_stop && one.is_loose() == other.is_loose();
  return one.key() == other.key() || one.stands_for(other) || other.stands_for(one) || of_one_damper;
}

/// The second parameter of [branch], if there is one, and the special points that are followed across it.
void add_second_parameter(const Settings& settings, branches::BranchSettings& branch) {
  const Setting *const across = settings.find("branch", "across"), *const curve = settings.find("branch", "curve"),
                       *const range = settings.find("branch", "across_range");
  for (const Setting* const of_it : {curve, range})
    if (across == nullptr && of_it != nullptr) refuse_missing_across(settings, of_it->key->name, of_it->key_location);
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

/// The births that are followed; nothing if the key isn't given.
std::optional<branches::OfBirths<bool>> births_of(const Settings& settings) {
  const Setting* const given = settings.find("branch", "births");
  if (given == nullptr) return std::nullopt;
  const std::vector<std::string> chosen = split_names(std::get<std::string>(given->value));
  branches::OfBirths<bool> births{};
  for (std::size_t kind = 0; kind < births.size(); ++kind)
    births[kind] = std::ranges::find(chosen, branches::birth_names[kind]) != chosen.end();
  return births;
}

/// [branch], with ranges in the user's units; nothing if no key of it is given. Throws ConfigError if a key is missing,
/// a value of a range isn't permitted, or [sweep] has an axis of the same key.
std::optional<branches::BranchSettings> branch_settings_of(const Settings& settings) {
  const Setting *const along = settings.find("branch", "along"), *const range = settings.find("branch", "range");
  const auto asks_for_branch = [](const Setting& setting) {
    const Key& key = *setting.key;
    return key.section == "branch" && (key.fallback.empty() || setting.value != default_setting(key).value);
  };
  if (along == nullptr && std::ranges::none_of(settings.values, asks_for_branch)) return std::nullopt;
  const bool is_si = settings.is_si();
  if (along == nullptr) refuse_missing_along(settings);
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
                                  .generations = settings.integer("branch", "switch"),
                                  .births = births_of(settings)};
  add_second_parameter(settings, branch);
  return branch;
}

/// Refuses a configuration whose complete text would be too long to be read again, at the longest of its values.
[[noreturn]] void refuse_long(const Settings& settings) {
  std::size_t longest = 0;
  SourceLocation location{settings.file, 1, 1};
  std::string name, way_out;
  for (const auto* const list : {&settings.values, &settings.axes}) {
    for (const Setting& setting : *list) {
      const std::size_t length = toml_value(setting).size();
      if (length <= longest || setting.key->name == "force_table") continue;
      longest = length, location = setting.key_location, name = setting.key->name;
      way_out = setting.is_axis() ? "write it as a function, e.g. linspace(a, b, n)" : "shorten it";
    }
  }
  fail(location, "the complete configuration is more than 1 MiB, of which '" + name + "' takes " +
                     std::to_string(longest) + " bytes; " + way_out);
}

Config config_of(ParsedConfig parsed) {
  Settings settings = check_keys(std::move(parsed));
  let_command_line_win(settings);
  read_force_table(settings);
  check_loose_mass(settings);
  check_alternatives(settings);
  spread_sobol(settings);
  const AxisGroups groups = group_axes(settings);
  check_housing(settings, groups);
  check_soft_walls(settings, groups);
  check_restitutions(settings, groups);
  check_force_table(settings);
  check_force_shape(settings);
  check_stop_motion(settings, groups);
  check_stops_and_start(settings, groups);
  check_soft_stops(settings, groups);
  check_sensitivity(settings);
  Config config;
  config.title = settings.text("", "title"), config.source = settings.text("", "source");
  config.text = config_text(settings);
  if (config.text.size() > max_config_bytes + bytes_of_force_table(settings)) refuse_long(settings);
  config.comment = told_of_force_table(settings);
  if (!config.comment.empty()) config.notes.push_back(config.comment);
  for (const Replaced& replaced : settings.replaced)
    if (!replaced.is_surplus) config.notes.push_back(to_string(replaced));
  config.warnings = warnings_of(settings, groups);
  config.compression = static_cast<int>(settings.integer("output", "compression"));
  config.sweep = sweep_of(settings, groups);  // takes the values of the axes
  config.branch = branch_settings_of(settings);
  return config;
}

}  // namespace

Config read_config(const std::string& path, const std::vector<Override>& overrides, Format format) {
  ParsedConfig parsed = read_parsed(path, format);
  apply_overrides(parsed, overrides);
  return config_of(std::move(parsed));
}

Config parse_config(const std::string& text, const std::string& file, const std::vector<Override>& overrides) {
  ParsedConfig parsed = read_toml(file, text);
  apply_overrides(parsed, overrides);
  return config_of(std::move(parsed));
}

}  // namespace clatter::config
