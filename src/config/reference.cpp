#include "config/reference.hpp"

#include "config/config_text.hpp"
#include "config/settings.hpp"
#include "config/wrapped.hpp"

namespace clatter::config {
namespace {

constexpr std::string_view about_values = R"text(Values, in TOML, in INI and after --set:
  0.5   2*pi   -pi/2   a number; pi may stand as a number or factor (in TOML in
                       quotes: "2*pi")
  3 mm   2*pi rad/s    a number with its unit, for keys of [machine] and, beside
                       them, duration and the ranges of [branch]: products and
                       quotients of m, s, N, J, W, g, Hz, rad with prefixes (n u
                       m c d k M G; for u also the micro sign), powers, and of
                       min, rpm, deg (or the degree sign): N s/m, m s-1, 1/min;
                       in TOML in quotes: "3 mm"
  60 %   30 deg        a number without unit, and an angle, also in [scene]; in
                       TOML in quotes: "60 %"
  linspace(a, b, n)    n values from a to b in equal steps, both included
  logspace(a, b, n)    n values from a to b (not exponents) in equal ratios; a
                       and b of the same sign
  arange(a, b, step)   a, a + step, ... ; b is excluded
  sobol(a, b, n)       n values spread evenly over a ... b by Sobol's sequence;
                       several such axes, linked, fill all their ranges
                       together
  [a, b, c]            a list; in INI and after --set the brackets may be left
                       out

In TOML the functions stand in quotes: nu = "linspace(0.5, 1.5, 501)". In INI
quotes around a value are dropped, comments begin with ; or #, and a title or
source that holds one of them after a blank needs quotes. An axis has at most
10 million values, a sweep 1000 million points, a configuration 1 MiB
beside the rows of a measured force.
)text";

/// The default in words.
std::string fallback(const Key& key) {
  if (key.kind == Kind::text && !key.other.empty()) return "none";
  const std::string other(key.other);
  if (!other.empty())
    return std::string(key.fallback.empty() ? "none" : key.fallback) + ", or " + other + " if that is given";
  if (!key.has_default()) return key.kind == Kind::choices ? "all" : "none";
  return key.fallback.empty() ? "empty" : std::string(key.fallback);
}

constexpr std::size_t indent = 21;

/// A name and its explanation in two columns; a name that is too long for the first one has a line of its own.
std::string row(std::string_view name, std::string_view help) {
  std::string text = "  " + std::string(name);
  if (text.size() < indent) {
    text.resize(indent, ' ');
  } else {
    text += '\n' + std::string(indent, ' ');
  }
  return text + wrapped(help, indent);
}

std::string entry(const Key& key) { return row(key.name, key.help) + row("", permitted_and_default(key)); }

std::string header(std::string_view section) {
  return section.empty() ? "Before the first section\n" : '[' + std::string(section) + "]\n";
}

/// Indents every line by two columns.
std::string indented(std::string_view lines) {
  std::string text;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin) + 1;
    (text += end - begin > 1 ? "  " : "") += lines.substr(begin, end - begin);
    begin = end;
  }
  return text;
}

/// An axis of ten steps up to the key's example.
std::string example_axis(const Key& key) {
  const double end = std::get<double>(example_setting(key).value);
  return "linspace(" + number_text(end / 2) + ", " + number_text(end) + ", 11)";
}

/// A command that sets a key.
std::string set_command(std::string_view section, const Key& key, const std::string& value) {
  constexpr std::size_t columns = 80;
  const bool plain = value.find_first_of(" (") == std::string::npos;
  const std::string command = "  clatter run mine.toml", set = " --set " + std::string(section) +
                                                               (section.empty() ? "" : ".") + std::string(key.name) +
                                                               '=' + (plain ? value : '\'' + value + '\'');
  const bool fits = command.size() + set.size() <= columns;
  return command + (fits ? "" : " \\\n   ") + set + '\n';
}

}  // namespace

std::string permitted_and_default(const Key& key) { return permitted(key) + "; default: " + fallback(key); }

std::string_view value_reference() { return about_values; }

std::string section_reference(std::string_view section) {
  std::string text = header(section);
  if (section == "sweep") {
    text += row("any key of [scene]", axes_help);
  }
  for (const Key& key : keys()) {
    if (key.section == section) text += entry(key);
  }
  return text;
}

std::string configuration_reference() {
  std::string text = section_reference("") + '\n';
  for (const std::string_view section : sections()) text += section_reference(section) + '\n';
  return text + std::string(about_values);
}

std::string key_example(const Key& key) {
  const std::string line = std::string(key.name) + " = " + toml_value(example_setting(key)) + '\n';
  const bool has_header = key.section.empty() || key.beside.starts_with('[');
  return (has_header ? "" : header(key.section)) + std::string(key.beside) + line;
}

std::string axis_example(const Key& key) {
  const std::string beside = key.beside.empty() ? "" : header(key.section) + std::string(key.beside) + '\n';
  return beside + header("sweep") + std::string(key.name) + " = " + toml_text(example_axis(key)) + '\n';
}

std::string key_reference(const Key& key) {
  const std::string location =
      key.section.empty() ? ", before the first section" : " in [" + std::string(key.section) + ']';
  std::string text = std::string(key.name) + location + "\n  " + wrapped(key.help, 2) + "  " +
                     wrapped(permitted_and_default(key), 2) + "\nExample\n" + indented(key_example(key)) + '\n' +
                     set_command(key.section, key, std::string(key.example));
  if (describes_scene(key.section) && key.kind == Kind::number)
    text +=
        "\nAs an axis of a sweep\n" + indented(axis_example(key)) + '\n' + set_command("sweep", key, example_axis(key));
  return text;
}

}  // namespace clatter::config
