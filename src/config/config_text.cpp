#include "config/config_text.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>

#include "config/consistency.hpp"
#include "config/force_table.hpp"
#include "config/keys.hpp"
#include "config/restitution.hpp"
#include "config/settings.hpp"
#include "config/unit.hpp"
#include "config/wrapped.hpp"

namespace clatter::config {
namespace {

bool is_swept(const Settings& settings, const Key& key) {
  return std::ranges::find(settings.axes, &key, &Setting::key) != settings.axes.end();
}

/// Whether a soft stop, or wall, or a table by speed excludes a key, which is a restitution.
bool is_excluded(const Settings& settings, const Key& key) {
  const auto by = [&](bool (*is_soft)(const Settings&, Side), const std::string& both) {
    const bool lower = is_soft(settings, Side::lower), upper = is_soft(settings, Side::upper);
    return (key.name == both && (lower || upper)) || (key.name == both + "_lower" && lower) ||
           (key.name == both + "_upper" && upper);
  };
  return by(is_soft_somewhere, "R") || by(is_soft_wall_somewhere, "loose_R") || has_speed_table(settings, key.name);
}

/// Whether the key of either stop is given, in place of that of both.
bool is_half_given(const Settings& settings, std::string_view both) {
  for (const Parameter half : all_parameters)
    if (half.row().other == both && settings.given(half) != nullptr) return true;
  return false;
}

/// Whether a restitution of soft stops stands in the place of a key, which is a damping of them.
bool is_damped_otherwise(const Settings& settings, const Key& key) {
  const auto given = [&](const std::string& restitution) {
    return settings.given(Parameter::of(restitution).value()) != nullptr;
  };
  for (const auto& [damping, restitution] :
       {std::pair<std::string, std::string>{"stop_damping", "stop_R"}, {"loose_wall_damping", "loose_wall_R"}}) {
    const bool both = given(restitution), lower = given(restitution + "_lower"), upper = given(restitution + "_upper");
    if (key.name == damping && (both || lower || upper)) return true;
    if (key.name == damping + "_lower" && (both || lower)) return true;
    if (key.name == damping + "_upper" && (both || upper)) return true;
  }
  return false;
}

/// Whether a key is one of a loose mass.
bool is_of_loose_mass(const Key& key) {
  const auto parameter = describes_scene(key.section) ? Parameter::of(key.name) : std::nullopt;
  return parameter && parameter->is_loose();
}

/// Whether a key is one of soft walls.
bool is_of_soft_walls(const Key& key) {
  const auto parameter = is_of_loose_mass(key) ? Parameter::of(key.name) : std::nullopt;
  return parameter && (parameter->role() == Role::softness || parameter->role() == Role::stop_damping);
}

/// Whether a key says how a restitution depends on the speed: not at all, unless it is given.
bool is_law_of_speed(const Key& key) {
  const auto parameter = describes_scene(key.section) ? Parameter::of(key.name) : std::nullopt;
  return parameter && parameter->role() == Role::law_of_speed;
}

/// Whether a key is of a force that is no sine, or of the motion of one stop by itself: of neither are there defaults
/// in the text, as most scenes have none.
bool is_of_few(const Key& key) {
  if (key.name == "force_shape" || key.name.starts_with("force_table")) return true;
  const auto parameter = describes_scene(key.section) ? Parameter::of(key.name) : std::nullopt;
  const Role role = parameter ? parameter->role() : Role::other;
  return role == Role::force_shape || role == Role::force_order || role == Role::stop_motion;
}

/// Whether the default of a key belongs in the text: not if its alternative was given.
bool default_counts(const Settings& settings, const Key& key) {
  if (is_of_few(key)) return false;
  if ((key.name == "f" || key.name == "force") && has_force_table(settings)) return false;
  if (is_excluded(settings, key) || is_damped_otherwise(settings, key)) return false;
  if (is_of_loose_mass(key) && !has_loose_mass(settings)) return false;
  const bool has_soft_wall =
      is_soft_wall_somewhere(settings, Side::lower) || is_soft_wall_somewhere(settings, Side::upper);
  if (is_of_soft_walls(key) && !has_soft_wall) return false;
  if (key.other == "xs" || key.other == "gap") return !settings.given_symmetric_stops();
  if (!key.other.empty())
    return !key.fallback.empty() &&
           (is_half_given(settings, key.other) || (has_speed_table(settings, key.other) && !is_law_of_speed(key)));
  if (is_half_given(settings, key.name) || is_law_of_speed(key)) return false;
  if (key.name == "x0" || key.name == "v0") return !settings.given("start_period");
  if (key.name == "damping") return !settings.given("damping_ratio") && !settings.given("quality");
  return key.has_default();
}

/// The lines of one section; axes come first, in their order.
std::string section_text(const Settings& settings, std::string_view section) {
  if (section == "branch" && settings.find("branch", "along") == nullptr) return {};  // nothing to be followed
  if (describes_scene(section) && section != settings.scene_section) return {};
  std::string text;
  const auto add = [&](std::string_view name, const std::string& value) {
    text += std::string(name) + " = " + value + '\n';
  };
  if (section == "sweep") {
    for (const Setting& axis : settings.axes) add(axis.key->name, toml_value(axis));
  }
  for (const Key& key : keys()) {
    if (key.section != section || is_swept(settings, key)) continue;
    if (const Setting* const given = settings.find(section, key.name)) {
      add(key.name, toml_value(*given));
    } else if (default_counts(settings, key)) {
      add(key.name, toml_value(default_setting(key)));
    }
  }
  return text;
}

constexpr std::string_view toml_head =
    "# Every key of clatter with its default. A line such as \"#R_lower = 0.5\" shows\n"
    "# a key that is not in use. Values: 0.5, 2*pi in quotes; axes: [a, b, c],\n"
    "# \"linspace(a, b, n)\", \"logspace(a, b, n)\", \"arange(a, b, step)\",\n"
    "# \"sobol(a, b, n)\".\n\n";
constexpr std::string_view ini_head =
    "; Every key of clatter with its default. A line such as \";R_lower = 0.5\" shows\n"
    "; a key that is not in use. Values: 0.5, 2*pi; axes: a, b, c or\n"
    "; linspace(a, b, n), logspace(a, b, n), arange(a, b, step), sobol(a, b, n).\n\n";

constexpr const char* machine_help = " the scene in SI, in place of [scene]: delete that, and uncomment lines here\n";

/// The value to show: the default, or an example if there is none.
std::string shown_value(const Key& key, Format format) {
  const Setting shown = key.has_default() ? default_setting(key) : example_setting(key);
  if (format == Format::toml) return toml_value(shown);
  return std::string(key.has_default() ? key.fallback : key.example);
}

/// Whether a key of the commented configuration is in use. Of keys without a default only xs is, since a scene needs
/// stops; [machine] isn't, since [scene] is, nor are a loose mass, which goes with no stops, what makes R depend on the
/// speed, other forces than a sine, and stops that move by themselves.
bool is_used(const Key& key) {
  return key.section != "machine" && !is_of_loose_mass(key) && !is_law_of_speed(key) && !is_of_few(key) &&
         (key.has_default() || key.name == "xs");
}

/// Rows of a measured force, as lines if they are plain text.
std::string toml_rows(const std::string& rows) {
  const auto is_plain = [](char c) {
    return c == '\n' || c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
  };
  const bool are_lines = rows.ends_with('\n') && rows.find('\'') == std::string::npos;
  return are_lines && std::ranges::all_of(rows, is_plain) ? "'''\n" + rows + "'''" : toml_text(rows);
}

/// One key of the commented configuration below its meaning.
std::string commented(const Key& key, Format format) {
  const std::string mark = format == Format::toml ? "#" : ";";
  const std::string value = shown_value(key, format), meaning = std::string(key.help) + " (" + permitted(key) + ')';
  return mark + ' ' + wrapped(meaning, mark + ' ') + (is_used(key) ? "" : mark) + std::string(key.name) +
         (value.empty() ? " =" : " = ") + value + '\n';
}

}  // namespace

std::string toml_value(const Setting& setting) {
  const bool has_other = setting.quantity != Quantity::number && setting.quantity != setting.key->quantity;
  const auto text = [&](const auto& value) -> std::string {
    using Type = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Type, std::string>)
      return setting.key->name == "force_table" ? toml_rows(value) : toml_text(value);
    if constexpr (std::is_same_v<Type, double>)
      return has_other ? toml_measure(value, unit_of_numbers(setting.quantity)) : toml_number(value);
    if constexpr (std::is_same_v<Type, std::int64_t>) return std::to_string(value);
    if constexpr (std::is_same_v<Type, bool>) return value ? "true" : "false";
    if constexpr (std::is_same_v<Type, Interval>) return toml_list({value.begin(), value.end()});
    if constexpr (std::is_same_v<Type, AxisValues>) return value.text;
  };
  return std::visit(text, setting.value);
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\') {
      quoted += {'\\', character};
    } else if (byte < 0x20 || byte == 0x7F) {
      constexpr std::string_view digits = "0123456789ABCDEF";
      quoted += {'\\', 'u', '0', '0', digits[byte / 16], digits[byte % 16]};
    } else {
      quoted += character;
    }
  }
  return quoted + '"';
}

std::string config_text(const Settings& settings) {
  std::string text = section_text(settings, "");
  for (const std::string_view section : sections()) {
    const std::string lines = section_text(settings, section);
    if (!lines.empty() || section == settings.scene_section) text += "\n[" + std::string(section) + "]\n" + lines;
  }
  return text;
}

std::string default_config(Format format) {
  const bool toml = format == Format::toml;
  std::string text(toml ? toml_head : ini_head);
  std::string_view section;
  for (const Key& key : keys()) {
    if (key.section != section) {
      text += "\n[" + std::string(section = key.section) + "]\n";
      if (section == "machine") text += std::string(toml ? "#" : ";") + machine_help;
    }
    if (key.name == "linked") {
      text += toml ? "# one axis a line, any key of [scene] or [machine]; the first varies slowest\n#nu = "
                     "\"linspace(0.5, 1.5, 501)\"\n"
                   : "; one axis a line, any key of [scene] or [machine]; the first varies slowest\n;nu = "
                     "linspace(0.5, 1.5, 501)\n";
    }
    text += commented(key, format);
  }
  return text;
}

}  // namespace clatter::config
