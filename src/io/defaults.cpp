#include "io/defaults.hpp"

#include <string_view>

#include "io/config_text.hpp"
#include "io/keys.hpp"
#include "io/settings.hpp"

namespace clatter {
namespace {

constexpr std::string_view toml_head =
    "# Every key of clatter with its default. A line such as \"#R_lower = 1\" shows a key that is not in use.\n"
    "# Values: 0.5, 2*pi in quotes; axes: \"linspace(a, b, n)\", \"logspace(a, b, n)\", \"arange(a, b, step)\", [a, b, "
    "c].\n\n";
constexpr std::string_view ini_head =
    "; Every key of clatter with its default. A line such as \";R_lower = 1\" shows a key that is not in use.\n"
    "; Values: 0.5, 2*pi; axes: linspace(a, b, n), logspace(a, b, n), arange(a, b, step), or a, b, c.\n\n";

constexpr std::string_view grammar = R"text(Values, in TOML, in INI and after --set:
  0.5   2*pi   -pi/2           a number; pi may stand as a number or factor (in TOML in quotes: "2*pi")
  linspace(a, b, n)            n values from a to b in equal steps, both included
  logspace(a, b, n)            n values from a to b (not exponents) in equal ratios; a and b of the same sign
  arange(a, b, step)           a, a + step, ... ; b is excluded
  [a, b, c]                    a list; in INI and after --set the brackets may be left out

In TOML the functions stand in quotes: nu = "linspace(0.5, 1.5, 501)". In INI quotes around a value are dropped,
comments begin with ; or #, and a title or source that holds one of them after a blank needs quotes.
An axis has at most 10 million values, a sweep 1000 million points, a configuration 1 MiB.
)text";

/// The value to show: the default, or an example where there is none.
std::string shown_value(const Key& key, Format format) {
  if (!key.has_default()) return std::string(key.example);
  return format == Format::toml ? toml_value(default_setting(key)) : std::string(key.fallback);
}

/// One key of the commented configuration: its meaning, then the key; the stops have no default and must be given.
std::string commented(const Key& key, Format format) {
  const std::string mark = format == Format::toml ? "#" : ";";
  const bool used = key.has_default() || key.name == "xs";
  const std::string value = shown_value(key, format);
  return mark + ' ' + std::string(key.help) + " (" + permitted(key) + ")\n" + (used ? "" : mark) +
         std::string(key.name) + (value.empty() ? " =" : " = ") + value + '\n';
}

/// The text in lines of at most 100 characters, each after the same indent.
std::string wrapped(std::string_view text, std::size_t indent) {
  const std::size_t width = 100 - indent;
  std::string lines;
  while (text.size() > width) {
    const std::size_t blank = text.rfind(' ', width);
    lines += std::string(text.substr(0, blank)) + '\n' + std::string(indent, ' ');
    text.remove_prefix(blank + 1);
  }
  return lines + std::string(text) + '\n';
}

/// The default, for the reference.
std::string fallback(const Key& key) {
  const std::string other(key.other);
  if (!other.empty()) return std::string(key.fallback) + ", or " + other + " where that is given";
  if (!key.has_default()) return "none";
  return key.fallback.empty() ? "empty" : std::string(key.fallback);
}

std::string reference(const Key& key) {
  constexpr std::size_t indent = 21;
  std::string name = "  " + std::string(key.name);
  name.resize(indent, ' ');
  return name + wrapped(key.help, indent) + std::string(indent, ' ') + permitted(key) + "; default: " + fallback(key) +
         '\n';
}

}  // namespace

std::string default_config(Format format) {
  const bool toml = format == Format::toml;
  std::string text(toml ? toml_head : ini_head);
  std::string_view section;
  for (const Key& key : keys()) {
    if (key.section != section) text += "\n[" + std::string(section = key.section) + "]\n";
    if (key.name == "linked") {
      text +=
          toml ? "# one line an axis, any key of [scene]; the first varies slowest\n#nu = \"linspace(0.5, 1.5, 501)\"\n"
               : "; one line an axis, any key of [scene]; the first varies slowest\n;nu = linspace(0.5, 1.5, 501)\n";
    }
    text += commented(key, format);
  }
  return text;
}

std::string configuration_reference() {
  std::string text;
  std::string_view section = "none";
  for (const Key& key : keys()) {
    if (key.section != section) {
      text += key.section.empty() ? "Before the first section\n" : "\n[" + std::string(key.section) + "]\n";
      if (key.section == "sweep") {
        text +=
            "  any key of [scene] an axis, one a line; the first varies slowest; every combination of the axes is a "
            "point\n";
      }
      section = key.section;
    }
    text += reference(key);
  }
  return text + '\n' + std::string(grammar);
}

}  // namespace clatter
