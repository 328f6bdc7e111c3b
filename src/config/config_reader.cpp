#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include "config/branch_settings.hpp"
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
    if (given.key->section == settings.scene_section) set(problem, parameter_of(given), std::get<double>(given.value));
  return problem;
}

sweep::Sweep sweep_of(Settings& settings, const AxisGroups& groups) {
  sweep::Sweep sweep{.problem = given_problem(settings), .follow = followed_dimension(settings, groups)};
  sweep.problem.observe.of_soft_stops =
      is_soft_somewhere(settings, Side::lower) || is_soft_somewhere(settings, Side::upper);
  if (sweep.follow) sweep.direction = direction_of(settings);
  for (const std::vector<std::size_t>& group : groups) {
    sweep::Dimension& dimension = sweep.dimensions.emplace_back();
    for (const std::size_t axis : group) {
      Setting& setting = settings.axes[axis];
      dimension.push_back({parameter_of(setting), std::move(std::get<AxisValues>(setting.value).values)});
    }
  }
  return sweep;
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
  check_soft_stops(settings, groups);
  Config config;
  config.title = settings.text("", "title"), config.source = settings.text("", "source");
  config.text = config_text(settings);
  if (config.text.size() > max_config_bytes) refuse_long(settings);
  for (const Replaced& replaced : settings.replaced) config.notes.push_back(to_string(replaced));
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

Config parse_config(const std::string& text, const std::string& file) { return config_of(read_toml(file, text)); }

}  // namespace clatter::config
