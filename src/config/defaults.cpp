#include "config/defaults.hpp"

#include <string_view>

#include "config/config_text.hpp"
#include "config/keys.hpp"
#include "config/settings.hpp"
#include "config/wrapped.hpp"

namespace clatter::config {
namespace {

constexpr std::string_view toml_head =
    "# Every key of clatter with its default. A line such as \"#R_lower = 0.5\" shows\n"
    "# a key that is not in use. Values: 0.5, 2*pi in quotes; axes: [a, b, c],\n"
    "# \"linspace(a, b, n)\", \"logspace(a, b, n)\", \"arange(a, b, step)\",\n"
    "# \"sobol(a, b, n)\".\n\n";
constexpr std::string_view ini_head =
    "; Every key of clatter with its default. A line such as \";R_lower = 0.5\" shows\n"
    "; a key that is not in use. Values: 0.5, 2*pi; axes: a, b, c or\n"
    "; linspace(a, b, n), logspace(a, b, n), arange(a, b, step), sobol(a, b, n).\n\n";

constexpr const char* machine_help = " in place of [scene]: a scene in SI; values may have units, such as \"3 mm\"\n";

/// The value to show: the default, or an example if there is none.
std::string shown_value(const Key& key, Format format) {
  const Setting shown = key.has_default() ? default_setting(key) : example_setting(key);
  if (format == Format::toml) return toml_value(shown);
  return std::string(key.has_default() ? key.fallback : key.example);
}

/// One key of the commented configuration below its meaning. Of keys without a default only xs is in use, since a scene
/// needs stops, and [machine] isn't, since [scene] is.
std::string commented(const Key& key, Format format) {
  const std::string mark = format == Format::toml ? "#" : ";";
  const bool used = key.section != "machine" && (key.has_default() || key.name == "xs");
  const std::string value = shown_value(key, format), meaning = std::string(key.help) + " (" + permitted(key) + ')';
  return mark + ' ' + wrapped(meaning, mark + ' ') + (used ? "" : mark) + std::string(key.name) +
         (value.empty() ? " =" : " = ") + value + '\n';
}

}  // namespace

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
      text +=
          toml ? "# one line an axis, any key of [scene]; the first varies slowest\n#nu = \"linspace(0.5, 1.5, 501)\"\n"
               : "; one line an axis, any key of [scene]; the first varies slowest\n;nu = linspace(0.5, 1.5, 501)\n";
    }
    text += commented(key, format);
  }
  return text;
}

}  // namespace clatter::config
