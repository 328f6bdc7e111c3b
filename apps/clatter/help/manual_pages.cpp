#include "help/manual_pages.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "commands/commands.hpp"
#include "config/reference.hpp"
#include "config/wrapped.hpp"
#include "results/version.hpp"

namespace clatter::app {
namespace {

/// Text as roff: a dash that can be copied, quotes as they are typed, and no line that is taken for a request.
std::string roff(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool begins_word = i == 0 || text[i - 1] == ' ' || text[i - 1] == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if (c == '\'')
      escaped += "\\(aq";
    else if (c == '`')
      escaped += "\\(ga";
    else if (c == '^')
      escaped += "\\(ha";
    else if (c == '~')
      escaped += "\\(ti";
    else
      (escaped += c == '.' && begins_word ? "\\&" : "") += c;
  }
  return escaped;
}

/// Text in lines of at most 80 columns.
std::string prose(std::string_view text) { return config::wrapped(roff(text), 0); }

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

std::string section(std::string_view title, const std::string& body) {
  return ".SH " + std::string(title) + '\n' + body;
}

/// A term, already roff, and its explanation below.
std::string item(const std::string& term, const std::string& explanation) {
  return ".TP\n" + term + '\n' + explanation;
}

/// Lines as they are, without the indent that the help gives to each.
std::string verbatim(std::string_view lines) {
  std::string text;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin) + 1;
    const std::string_view line = lines.substr(begin, end - begin);
    text += roff(line.substr(line.starts_with("  ") ? 2 : 0));
    begin = end;
  }
  std::string spaced;  // an empty line in the source of a page is bad style
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool empty_line = text[i] == '\n' && i > 0 && text[i - 1] == '\n';
    (spaced += empty_line ? "\\&" : "") += text[i];
  }
  return ".nf\n" + spaced + ".fi\n";
}

std::string page_name(const Command& command) { return "clatter-" + std::string(command.name); }

std::string reference_to(std::string_view page, char volume) { return bold(page) + '(' + volume + ')'; }

/// References to other pages, a line each with commas between.
std::string see_also(const std::vector<std::string>& pages) {
  std::string text;
  for (const std::string& page : pages) (text += text.empty() ? "" : ",\n") += page;
  return section("SEE ALSO", text + '\n');
}

ManualPage page(std::string_view name, char volume, std::string_view summary, const std::string& body) {
  std::string title(name);
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::string folder = std::string("man/man") + volume + '/';
  return {folder + std::string(name) + '.' + volume,
          ".TH " + roff(title) + ' ' + volume + ' ' + std::string(results::release_date()) + " \"clatter " +
              std::string(results::version()) + "\" \"clatter\"\n" +
              section("NAME", config::wrapped(roff(name) + " \\- " + roff(summary), 0)) + body};
}

std::string option_item(const Option& option) {
  std::string term = option.letter != 0 ? bold(std::string{'-', option.letter}) + ", " : "";
  term += bold("--" + std::string(option.name));
  if (!option.argument.empty()) term += ' ' + italic(option.argument);
  return item(term, prose(option.help));
}

std::string option_items(std::span<const Option> options) {
  std::string text;
  for (const Option& option : options) text += option_item(option);
  return text;
}

std::string examples_section(std::string_view lines) { return section("EXAMPLES", verbatim(lines)); }

ManualPage command_page(const Command& command) {
  const std::string_view operands = command.usage.substr(command.name.size());
  const std::string synopsis = bold("clatter " + std::string(command.name)) + roff(operands) + '\n';
  return page(page_name(command), '1', command.summary,
              section("SYNOPSIS", synopsis) + section("OPTIONS", option_items(command.options)) +
                  (command.notes.empty() ? "" : section("NOTES", prose(command.notes))) +
                  examples_section(command.examples) +
                  see_also({reference_to("clatter", '1'), reference_to("clatter-config", '5')}));
}

constexpr std::string_view program_description =
    "clatter computes how a mass on a spring and a damper, shaken by a harmonic force, knocks between stops:";
constexpr std::string_view equations =
    "  x'' + 2 h x' + x = f sin(nu tau + phase) + load,\n"
    "  x' after an impact = -R times x' before it.\n";
constexpr std::string_view method =
    "It follows the motion from impact to impact in closed form, sweeps any of these parameters on all cores, finds "
    "the "
    "steady motion at each point, and writes one HDF5 file that is netCDF-4 too. A configuration in TOML or INI says "
    "which scenes to run and which of their results to keep.";

ManualPage program_page() {
  std::string items, codes;
  std::vector<std::string> others{reference_to("clatter-config", '5')};
  for (const Command& command : commands()) {
    items += item(reference_to(page_name(command), '1'), prose(command.summary));
    others.push_back(reference_to(page_name(command), '1'));
  }
  for (const ExitMeaning& exit : exit_meanings()) codes += item(bold(exit.code), prose(exit.meaning));
  const std::string synopsis = bold("clatter") + ' ' + italic("COMMAND") + " [" + italic("ARGUMENT") + "]...\n";
  return page(
      "clatter", '1', program_summary,
      section("SYNOPSIS", synopsis) +
          section("DESCRIPTION", prose(program_description) + ".PP\n" + verbatim(equations) + ".PP\n" + prose(method)) +
          section("COMMANDS", items) + section("OPTIONS", option_items(program_options())) +
          section("ENVIRONMENT", item(bold("CLATTER_ARCH"),
                                      prose("instruction set to compute with, as --arch of a command names it"))) +
          section("FILES", item(italic("FILE.h5.journal"),
                                prose("finished points of a run that was stopped; the same command continues "
                                      "from there"))) +
          section("EXIT STATUS", codes) + examples_section(program_examples()) + see_also(others));
}

std::string key_item(std::string_view name, std::string_view help, const std::string& values) {
  return item(bold(name), prose(help) + (values.empty() ? "" : ".br\n" + prose(values)));
}

std::string section_of_keys(std::string_view name) {
  std::string text = ".SS " + (name.empty() ? "Before the first section" : roff('[' + std::string(name) + ']')) + '\n';
  if (name == "sweep") text += item("any key of " + bold("[scene]"), prose(config::axes_help));
  for (const Key& key : config::keys())
    if (key.section == name) text += key_item(key.name, key.help, config::permitted_and_default(key));
  return text;
}

constexpr std::string_view example =
    "  title = \"Resonance between stops\"\n"
    "\n"
    "  [scene]\n"
    "  h = 0.1\n"
    "  f = 1.0\n"
    "  R = 0.7\n"
    "  xs = 0.5\n"
    "\n"
    "  [sweep]\n"
    "  nu = \"linspace(0.5, 1.5, 501)\"\n"
    "\n"
    "  [observe]\n"
    "  extrema = true\n"
    "  impacts = true\n";

ManualPage config_page() {
  std::string sections = section_of_keys("");
  for (const std::string_view name : config::sections()) sections += section_of_keys(name);
  const std::string about = prose(
      "A configuration describes the scene, the axes of a sweep over its keys, and the results to keep. It is TOML, or "
      "INI if its name ends in .ini or --ini is given. Wrong keys and values are refused with their line and the way "
      "out; --set SECTION.KEY=VALUE replaces a value for one run. `clatter defaults` prints a complete configuration "
      "with comments.");
  return page("clatter-config", '5', "configuration of clatter, in TOML or INI",
              section("DESCRIPTION", about) + section("KEYS", sections) +
                  section("VALUES", verbatim(config::value_reference())) + section("EXAMPLE", verbatim(example)) +
                  see_also({reference_to("clatter", '1')}));
}

}  // namespace

std::vector<ManualPage> manual_pages() {
  std::vector<ManualPage> pages{program_page(), config_page()};
  for (const Command& command : commands()) pages.push_back(command_page(command));
  return pages;
}

}  // namespace clatter::app
