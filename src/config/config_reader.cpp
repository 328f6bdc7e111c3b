#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include "config/config.hpp"
#include "config/config_text.hpp"
#include "config/consistency.hpp"
#include "config/parsed_config.hpp"
#include "config/settings.hpp"
#include "config/text_file.hpp"
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

/// Gives a sweep the scene or the machine before any axis is applied; a key that isn't given keeps the value that
/// Problem or Machine has.
void set_scene(const Settings& settings, sweep::Sweep& sweep) {
  sweep.problem.time = time_settings(settings);
  sweep.problem.observe = observe(settings);
  sweep.problem.integration = integration(settings);
  if (settings.is_si()) sweep.machine.emplace();
  for (const Setting& given : settings.values) {
    if (given.key->section != settings.scene_section) continue;
    const sweep::Parameter parameter = sweep::parameter_of(given.key->name).value();
    const double value = std::get<double>(given.value);
    if (parameter == sweep::Parameter::start_period) {
      sweep.start_period = value;
    } else if (!sweep.machine || !sweep::set(*sweep.machine, parameter, value)) {
      sweep::set(sweep.problem, parameter, value);
    }
  }
}

sweep::Sweep sweep_of(Settings& settings, const AxisGroups& groups) {
  sweep::Sweep sweep{.follow = followed_dimension(settings, groups)};
  set_scene(settings, sweep);
  sweep.problem.observe.of_soft_stops =
      is_soft_somewhere(settings, Side::lower) || is_soft_somewhere(settings, Side::upper);
  if (sweep.follow) sweep.direction = direction_of(settings);
  for (const std::vector<std::size_t>& group : groups) {
    sweep::Dimension& dimension = sweep.dimensions.emplace_back();
    for (const std::size_t axis : group) {
      Setting& setting = settings.axes[axis];
      dimension.push_back(
          {sweep::parameter_of(setting.key->name).value(), std::move(std::get<AxisValues>(setting.value).values)});
    }
  }
  return sweep;
}

/// Throws ConfigError if a value of an interval isn't permitted for the key of [scene] that it is about, or [sweep] has
/// an axis of that key, too.
void check_followed(const Settings& settings, const std::string& name, std::string_view chosen_by,
                    const Setting* interval) {
  const Key& key = *find_key("scene", name);
  if (interval != nullptr)
    for (const double end : std::get<Interval>(interval->value))
      if (!contains(key.range, end))
        fail(interval->location, std::string(interval->key->name) + " has " + name + " = " + number_text(end) +
                                     "; expected " + permitted(key));
  if (name == "xs" && interval != nullptr && std::get<Interval>(interval->value)[0] < 0)
    fail(interval->location, "xs stands for |xs|; expected two numbers above 0");
  for (const Setting& axis : settings.axes)
    if (axis.key->name == name)
      fail(axis.key_location, "'" + name + "' in both [sweep] and [branch] " + std::string(chosen_by) +
                                  "; remove it from [sweep], and give the value to begin at in [scene]");
}

/// Whether two keys of [scene] are one, or stand for a number of a stop that both change.
bool change_the_same(sweep::Parameter one, sweep::Parameter other) {
  using enum sweep::Parameter;
  const auto parts = [](sweep::Parameter parameter) {
    if (parameter == xs) return std::vector{stop_lower, stop_upper};
    if (parameter == R) return std::vector{R_lower, R_upper};
    if (parameter == stop_stiffness) return std::vector{stop_stiffness_lower, stop_stiffness_upper};
    if (parameter == stop_damping) return std::vector{stop_damping_lower, stop_damping_upper};
    return std::vector{parameter};
  };
  const std::vector<sweep::Parameter> first = parts(one), second = parts(other);
  return std::ranges::find_first_of(first, second) != first.end();
}

/// The second parameter of [branch], if there is one, and the special points that are followed across it. Throws
/// ConfigError as `branch_of` does.
void add_second_parameter(const Settings& settings, branches::BranchSettings& branch) {
  const Setting *const across = settings.find("branch", "across"), *const curve = settings.find("branch", "curve"),
                       *const range = settings.find("branch", "across_range");
  if (across == nullptr && curve != nullptr)
    fail(curve->key_location, "'curve' without 'across'; add the second parameter, e.g. across = \"xs\"");
  if (across == nullptr && range != nullptr)
    fail(range->key_location, "'across_range' without 'across'; add the second parameter, e.g. across = \"xs\"");
  if (across == nullptr) return;
  if (curve == nullptr)
    fail(across->key_location,
         "'across' without 'curve'; add the special points that are followed, e.g. curve = \"fold\"");
  const std::string name = settings.text("branch", "across");
  branch.across = sweep::parameter_of(name).value(), branch.curve = settings.text("branch", "curve");
  if (change_the_same(*branch.across, branch.along))
    fail(across->location, "'" + name + "' and '" + std::string(sweep::key_of(branch.along)) +
                               "' change the same quantity; expected another key of [scene]");
  check_followed(settings, name, "across", range);
  const AllowedRange& permitted_values = find_key("scene", name)->range;
  branch.across_range = {permitted_values.not_zero ? 0.0 : permitted_values.low, permitted_values.high};
  if (range != nullptr) branch.across_range = settings.interval("branch", "across_range");
}

/// [branch]. Throws ConfigError if a key is missing, or a value of a range isn't permitted, or [sweep] has an axis of
/// the same key.
std::optional<branches::BranchSettings> branch_of(const Settings& settings) {
  const Setting *const along = settings.find("branch", "along"), *const range = settings.find("branch", "range");
  const auto asks_for_branch = [](const Setting& setting) {
    const Key& key = *setting.key;
    return key.section == "branch" && (key.fallback.empty() || setting.value != default_setting(key).value);
  };
  if (along == nullptr && std::ranges::none_of(settings.values, asks_for_branch)) return std::nullopt;
  if (settings.is_si())
    fail(settings.location_of_section("branch"),
         "[branch] beside [machine]; a branch is followed in a scene without units: give [scene] the numbers that "
         "`clatter plan` prints without [branch]");
  if (along == nullptr)
    fail(settings.location_of_section("branch"), "[branch] without 'along'; add a key of [scene], e.g. along = \"nu\"");
  if (range == nullptr)
    fail(settings.location_of_section("branch"),
         "[branch] without 'range'; add the values to stop at, e.g. range = [0.8, 1.5]");
  const std::string name = settings.text("branch", "along");
  branches::BranchSettings branch{.along = sweep::parameter_of(name).value(),
                                  .range = settings.interval("branch", "range"),
                                  .period = settings.integer("branch", "period"),
                                  .tolerance = settings.number("branch", "tolerance"),
                                  .largest_step = settings.number("branch", "largest_step"),
                                  .max_points = settings.integer("branch", "max_points"),
                                  .generations = settings.integer("branch", "switch")};
  check_followed(settings, name, "along", range);
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
      if (length <= longest) continue;
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
  check_alternatives(settings);
  spread_sobol(settings);
  const AxisGroups groups = group_axes(settings);
  check_stops_and_start(settings, groups);
  check_soft_stops(settings);
  Config config{settings.text("", "title"),
                settings.text("", "source"),
                {},
                branch_of(settings),
                0,
                config_text(settings),
                {},
                {}};
  for (const Replaced& replaced : settings.replaced) config.notes.push_back(to_string(replaced));
  config.warnings = warnings_of(settings, groups);
  if (config.text.size() > max_config_bytes) refuse_long(settings);
  config.compression = static_cast<int>(settings.integer("output", "compression"));
  config.sweep = sweep_of(settings, groups);
  return config;
}

}  // namespace

Config read_config(const std::string& path, const std::vector<Override>& overrides, Format format) {
  ParsedConfig parsed = read_parsed(path, format);
  apply_overrides(parsed, overrides);
  return config_of(std::move(parsed));
}

Config parse_config(const std::string& text, const std::string& file) { return config_of(read_toml(file, text)); }

}  // namespace clatter::config
