#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "config/config.hpp"
#include "config/consistency.hpp"
#include "config/force_shape.hpp"
#include "config/force_table.hpp"
#include "config/restitution.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

bool transient(const Settings& settings) { return settings.text("time", "mode") == "transient"; }
bool steady(const Settings& settings) { return !transient(settings); }

bool no_harmonics(const Settings& settings) { return settings.integer("observe", "harmonics") == 0; }
bool follows_nothing(const Settings& settings) { return settings.text("sweep", "follow").empty(); }
bool no_section(const Settings& settings) { return settings.integer("observe", "section") == 0; }
bool exact_harmonics(const Settings& settings) { return settings.text("observe", "harmonics_method") == "exact"; }

bool not_by(const Settings& settings, std::string_view method) {
  return settings.text("integrator", "method") != method;
}
bool not_dopri5(const Settings& settings) { return not_by(settings, "dopri5"); }
bool not_moreau(const Settings& settings) { return not_by(settings, "moreau"); }
/// A general method simulates every effect anyway, and a transient has no repeat to look for.
bool all_anyway(const Settings& settings) { return transient(settings) && not_by(settings, "exact"); }

/// Whether a test holds for a parameter at every point, or the parameter isn't given.
template <typename Test>
bool everywhere(const Settings& settings, Parameter parameter, Test test) {
  const Setting* const given = settings.given(parameter);
  return given == nullptr || std::ranges::all_of(given->numbers(), test);
}
/// Whether a parameter is given, and a test holds for it at every point.
template <typename Test>
bool given_everywhere(const Settings& settings, Parameter parameter, Test test) {
  return settings.given(parameter) != nullptr && everywhere(settings, parameter, test);
}
bool zero(double value) { return value == 0; }
bool unshaken(const Settings& settings) {
  return everywhere(settings, "stop_amplitude", zero) && everywhere(settings, "base_amplitude", zero);
}
bool lower_stands(const Settings& settings) { return everywhere(settings, "stop_amplitude_lower", zero); }
bool upper_stands(const Settings& settings) { return everywhere(settings, "stop_amplitude_upper", zero); }
bool none_moves(const Settings& settings) {
  return unshaken(settings) && lower_stands(settings) && upper_stands(settings);
}
bool undriven(const Settings& settings) {
  if (has_force_table(settings)) return given_everywhere(settings, "force_factor", zero);
  for (const Parameter order : all_parameters)
    if (is_order_amplitude(order) && !everywhere(settings, order, zero)) return false;
  return everywhere(settings, "f", zero) && everywhere(settings, "force", zero);
}
bool unforced(const Settings& settings) { return undriven(settings) && none_moves(settings); }
bool has_no_duty(const Settings& settings) { return !has_duty(waveform_of(settings)); }
bool has_no_rise(const Settings& settings) { return waveform_of(settings) != Waveform::trapezoid; }
/// Whether nothing is observed that frame decides.
bool frameless(const Settings& settings) {
  return no_harmonics(settings) && no_section(settings) && !settings.flag("observe", "extrema") &&
         settings.integer("observe", "trajectory") == 0 && !settings.flag("observe", "attractor");
}
bool absent(const Settings& settings, Parameter stop) {
  return !settings.given_symmetric_stops() &&
         everywhere(settings, stop, [](double value) { return std::isinf(value); });
}
bool no_lower(const Settings& settings) { return absent(settings, "stop_lower"); }
bool no_upper(const Settings& settings) { return absent(settings, "stop_upper"); }
bool no_friction(const Settings& settings) { return !has_friction_somewhere(settings); }
bool no_word(const Settings& settings) { return !settings.flag("observe", "word"); }
bool no_soft_lower(const Settings& settings) { return !is_soft_somewhere(settings, Side::lower); }
bool no_soft_upper(const Settings& settings) { return !is_soft_somewhere(settings, Side::upper); }
bool no_soft_stop(const Settings& settings) { return no_soft_lower(settings) && no_soft_upper(settings); }
bool no_lower_wall(const Settings& settings) {
  return absent(settings, "loose_lower") && settings.given("loose_gap") == nullptr;
}
bool no_upper_wall(const Settings& settings) {
  return absent(settings, "loose_upper") && settings.given("loose_gap") == nullptr;
}
bool no_soft_lower_wall(const Settings& settings) { return !is_soft_wall_somewhere(settings, Side::lower); }
bool no_soft_upper_wall(const Settings& settings) { return !is_soft_wall_somewhere(settings, Side::upper); }
bool no_soft_wall(const Settings& settings) { return no_soft_lower_wall(settings) && no_soft_upper_wall(settings); }
bool no_stops(const Settings& settings) { return no_lower(settings) && no_upper(settings); }
bool no_impacts(const Settings& settings) { return no_stops(settings) && !has_loose_mass(settings); }

/// A transient has no period; at symmetric stops `period` still gives the ratio of velocities.
bool no_period(const Settings& settings) {
  if (steady(settings) || settings.given_symmetric_stops()) return false;
  const Setting *const lower = settings.given("stop_lower"), *const upper = settings.given("stop_upper");
  if (lower == nullptr || upper == nullptr) return true;
  return !lower->is_axis() && !upper->is_axis() && lower->numbers()[0] != -upper->numbers()[0];
}

/// Motion that nothing drives comes to a standstill, which has no period and passes nothing, if one of the parameters
/// brakes it at every point.
bool comes_to_a_standstill(const Settings& settings, std::initializer_list<Parameter> brakes) {
  const auto brakes_it = [&](Parameter parameter) {
    return given_everywhere(settings, parameter, [](double value) { return value > 0 && std::isfinite(value); });
  };
  return steady(settings) && unforced(settings) && std::ranges::any_of(brakes, brakes_it);
}
bool is_damped_out(const Settings& settings) {
  return comes_to_a_standstill(settings, {"h", "damping", "damping_ratio", "quality"});
}
bool is_rubbed_out(const Settings& settings) { return comes_to_a_standstill(settings, {"friction"}); }
/// Without a spring a section is taken at x = 0, to which a rigid stop at 0 or beyond lets no mass rise.
bool never_passes_zero(const Settings& settings) {
  const bool above =
      no_soft_lower(settings) && given_everywhere(settings, "stop_lower", [](double value) { return value >= 0; });
  const bool below =
      no_soft_upper(settings) && given_everywhere(settings, "stop_upper", [](double value) { return value <= 0; });
  return unforced(settings) && given_everywhere(settings, "stiffness", zero) && (above || below);
}

/// A condition under which a key has no effect, and how it would have one.
struct Rule {
  std::string_view section, name;
  bool (*holds)(const Settings&);
  std::string_view condition, remedy;
};

constexpr std::string_view in_transient = "in a transient", or_steady = "write mode = \"steady\" in [time]";
constexpr std::string_view no_force = "without a force", or_force = "give a force";
constexpr std::string_view damped_out =
    "without a force, since damping brings the mass to a standstill: its values will be NaN";
constexpr std::string_view rubbed_out =
    "without a force, since friction brings the mass to a standstill: its values will be NaN";
constexpr std::string_view or_drive = "give a force, or mode = \"transient\" in [time]";
constexpr std::string_view or_soft = "give a finite stop_stiffness";
constexpr std::string_view or_soft_wall = "give a finite loose_wall_stiffness";
constexpr std::string_view or_stops = "give stops";
constexpr std::string_view no_harmonic = "without harmonics", or_harmonics = "write e.g. harmonics = 3";
constexpr std::string_view only_moreau = "without method = \"moreau\"", or_moreau = "write that in [integrator]";

constexpr Rule rules[] = {
    {"scene", "nu", unforced, no_force, or_force},
    {"machine", "frequency", unforced, no_force, "give a force, stop_amplitude or base_amplitude"},
    {"scene", "phase", unforced, no_force, or_force},
    {"scene", "force_shape", undriven, no_force, or_force},
    {"scene", "force_duty", undriven, no_force, or_force},
    {"scene", "force_rise", undriven, no_force, or_force},
    {"scene", "force_duty", has_no_duty, "beside this shape of the force",
     "write force_shape = \"square\", \"pulse\" or \"half-sine\""},
    {"scene", "force_rise", has_no_rise, "beside this shape of the force", "write force_shape = \"trapezoid\""},
    {"scene", "force_factor", [](const Settings& settings) { return !has_force_table(settings); },
     "without force_table", "give that"},
    {"scene", "force_table_harmonics", [](const Settings& settings) { return !has_force_table(settings); },
     "without force_table", "give that"},
    {"scene", "stop_phase", none_moves, "without stop_amplitude or base_amplitude", "give one of them"},
    {"scene", "stop_phase_lower", lower_stands, "without stop_amplitude_lower", "give that"},
    {"scene", "stop_phase_upper", upper_stands, "without stop_amplitude_upper", "give that"},
    {"scene", "stop_stiffness", no_stops, "without stops", or_stops},
    {"scene", "stop_stiffness_lower", no_lower, "without a lower stop", "give stop_lower"},
    {"scene", "stop_amplitude_lower", no_lower, "without a lower stop", "give stop_lower"},
    {"scene", "stop_amplitude_upper", no_upper, "without an upper stop", "give stop_upper"},
    {"scene", "stop_stiffness_upper", no_upper, "without an upper stop", "give stop_upper"},
    {"scene", "stop_damping", no_soft_stop, "without a soft stop", or_soft},
    {"scene", "stop_damping_lower", no_soft_lower, "without a soft lower stop", or_soft},
    {"scene", "stop_damping_upper", no_soft_upper, "without a soft upper stop", or_soft},
    {"scene", "stop_R", no_stops, "without stops", or_stops},
    {"scene", "stop_R_lower", no_lower, "without a lower stop", "give stop_lower"},
    {"scene", "stop_R_upper", no_upper, "without an upper stop", "give stop_upper"},
    {"scene", "loose_wall_stiffness_lower", no_lower_wall, "without a lower wall", "give loose_lower"},
    {"scene", "loose_wall_stiffness_upper", no_upper_wall, "without an upper wall", "give loose_upper"},
    {"scene", "loose_wall_damping", no_soft_wall, "without a soft wall", or_soft_wall},
    {"scene", "loose_wall_damping_lower", no_soft_lower_wall, "without a soft lower wall", or_soft_wall},
    {"scene", "loose_wall_damping_upper", no_soft_upper_wall, "without a soft upper wall", or_soft_wall},
    {"sweep", "direction", follows_nothing, "without follow", "name an axis in follow"},
    {"time", "max_periods", transient, in_transient, or_steady},
    {"time", "window", transient, in_transient, or_steady},
    {"time", "tolerance", transient, in_transient, or_steady},
    {"time", "max_impacts", no_impacts, "without stops", or_stops},
    {"time", "duration", steady, "without mode = \"transient\"", "write that in [time]"},
    {"observe", "harmonics_method", no_harmonics, no_harmonic, or_harmonics},
    {"observe", "harmonics_samples", no_harmonics, no_harmonic, or_harmonics},
    {"observe", "harmonics_samples", exact_harmonics, "with harmonics_method = \"exact\"",
     "write harmonics_method = \"fft\""},
    {"observe", "settling", transient, in_transient, or_steady},
    {"observe", "settling", unforced, no_force, or_force},
    {"observe", "time_to_rest", steady, "without mode = \"transient\"", "write that in [time]"},
    {"observe", "attractor", transient, in_transient, or_steady},
    {"observe", "section", is_damped_out, damped_out, or_drive},
    {"observe", "section", is_rubbed_out, rubbed_out, or_drive},
    {"observe", "section", never_passes_zero,
     "without a force and a spring, since between these stops the mass never passes x = 0 on its way up: its values "
     "will be NaN",
     or_force},
    {"observe", "word_sticks", no_friction, "without friction", "give friction"},
    {"observe", "word_sticks", no_word, "without word", "write word = true"},
    {"observe", "section_phase", no_section, "without a section", "write e.g. section = 500"},
    {"observe", "section_phase", unforced, no_force, or_force},
    {"observe", "period", is_damped_out, damped_out, or_force},
    {"observe", "period", is_rubbed_out, rubbed_out, or_force},
    {"observe", "period", no_period, "in a transient, which has none: its values will be NaN", or_steady},
    {"observe", "frame", unshaken, "without stop_amplitude or base_amplitude", "give one of them in [scene]"},
    {"observe", "frame", frameless, "without displacements or velocities of the mass", "write e.g. extrema = true"},
    {"integrator", "tolerance", not_dopri5, "without method = \"dopri5\"",
     "write that in [integrator]; that of repeats is tolerance in [time]"},
    {"integrator", "step", not_moreau, only_moreau, or_moreau},
    {"integrator", "theta", not_moreau, only_moreau, or_moreau},
    {"integrator", "effects", all_anyway, "on a transient by a general method, which simulates every effect",
     "write method = \"exact\""},
};

bool is_default(const Setting& setting) {
  return !setting.key->fallback.empty() && setting.value == default_setting(*setting.key).value;
}

/// Adds a warning if a key has no effect.
void look_at(const Settings& settings, const Setting& setting, std::vector<Warning>& warnings) {
  const Key& key = *setting.key;
  const auto warn = [&](std::string_view condition, std::string_view remedy) {
    warnings.push_back({to_string(setting.key_location), std::string(key.section),
                        '\'' + std::string(key.name) + "' has no effect " + std::string(condition) +
                            "; leave it out, or " + std::string(remedy)});
  };
  if (const auto none = restitution_without_effect(settings, key)) return warn(none->condition, none->remedy);
  if (const auto order = describes_scene(key.section) ? Parameter::of(key.name) : std::nullopt;
      order && order->role() == Role::force_order && !is_order_amplitude(*order)) {
    const Parameter amplitude = amplitude_of_order(*order, settings.is_si());
    if (everywhere(settings, amplitude, zero)) return warn("without " + in_quotes(amplitude.key()), "give that");
  }
  for (const Rule& rule : rules) {
    const bool is_in_section =
        rule.section == key.section || (describes_scene(rule.section) && describes_scene(key.section));
    if (is_in_section && rule.name == key.name && rule.holds(settings)) return warn(rule.condition, rule.remedy);
  }
}

}  // namespace

std::vector<Warning> keys_without_effect(const Settings& settings) {
  std::vector<Warning> warnings;
  for (const auto* const list : {&settings.values, &settings.axes})
    for (const Setting& setting : *list)
      if (!is_default(setting)) look_at(settings, setting, warnings);
  return warnings;
}

}  // namespace clatter::config
