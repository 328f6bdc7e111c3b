#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "config/config.hpp"
#include "config/consistency.hpp"
#include "config/force_table.hpp"
#include "config/parsed_config.hpp"
#include "config/restitution.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

std::string words_of(const Override& change) { return change.option + ' ' + change.key + '=' + change.value; }

/// The command line has the encoding of the terminal or script, which need not be UTF-8.
void check_words(const Override& change) {
  const std::string words = words_of(change);
  const std::size_t wrong = storage::find_not_utf8(words);
  if (wrong != std::string::npos) {
    fail({storage::printable(words), 0, 0},
         "the byte " + storage::printable(words.substr(wrong, 1)) +
             " is not UTF-8; use a terminal (or a script) in UTF-8, or put the text in a file");
  }
  check_characters("--set", change.key + '=' + change.value);
}

ParsedEntry entry_of(const Override& change) {
  const SourceLocation location{words_of(change), 0, 0};
  const std::string key(without_blanks(change.key));
  const std::size_t dot = key.find('.');
  const bool top_level = dot == std::string::npos;
  ParsedEntry entry{top_level ? "" : key.substr(0, dot), top_level ? key : key.substr(dot + 1), location, {}};
  entry.value = {unquoted(without_blanks(change.value)), location, true, 0};
  return entry;
}

std::string quoted_name(Parameter parameter) { return in_quotes(parameter.key()); }

/// Whether a location comes after another one of the same origin.
bool later(const SourceLocation& left, const SourceLocation& right) {
  return std::tie(left.line, left.column) > std::tie(right.line, right.column);
}

/// Two locations contradict if both are in the file or both on the command line; otherwise the command line decides.
bool contradict(const SourceLocation& one, const SourceLocation& other) {
  return on_command_line(one) == on_command_line(other);
}

/// Refuses two keys that say the same, at the one that was written last.
void exclude(const Settings& settings, Parameter one, Parameter other) {
  const Setting* const first = settings.given(one);
  const Setting* const second = settings.given(other);
  if (first == nullptr || second == nullptr || !contradict(first->key_location, second->key_location)) return;
  const bool in_order = later(second->key_location, first->key_location);
  fail((in_order ? second : first)->key_location, quoted_name(in_order ? other : one) + " conflicts with " +
                                                      quoted_name(in_order ? one : other) + "; remove one of them");
}

bool from_command_line(const Setting* given) { return given != nullptr && on_command_line(given->key_location); }
bool from_file(const Setting* given) { return given != nullptr && !on_command_line(given->key_location); }

/// The key of a parameter in the section that describes the scene; nullptr if it has none.
const Key* key_of_scene(const Settings& settings, Parameter parameter) {
  return find_key(settings.scene_section, parameter.key());
}

/// Removes the file's setting of a parameter from the scene's section or [sweep].
void remove(Settings& settings, Parameter parameter) {
  for (auto* const list : {&settings.values, &settings.axes})
    std::erase_if(*list, [&](const Setting& setting) {
      return setting.key == key_of_scene(settings, parameter) && !on_command_line(setting.key_location);
    });
}

void note(Settings& settings, Parameter parameter, const SourceLocation& by, const SourceLocation& former,
          const std::string& remark = "") {
  settings.replaced.push_back({parameter.key(), by, former, remark, 0});
}

/// Lets the command line's setting of a parameter, in the scene's section or [sweep], replace that of the other section
/// in the file; of two in one place the axis counts, as somebody wants who turns a run into a sweep.
void choose_section(Settings& settings, Parameter parameter) {
  const Setting* const fixed = settings.find(settings.scene_section, parameter.key());
  const auto swept = std::ranges::find(settings.axes, key_of_scene(settings, parameter), &Setting::key);
  if (fixed == nullptr || swept == settings.axes.end()) return;
  const SourceLocation in_scene = fixed->key_location, in_sweep = swept->key_location;
  const bool by_axis = contradict(in_scene, in_sweep) || on_command_line(in_sweep);
  note(settings, parameter, by_axis ? in_sweep : in_scene, by_axis ? in_scene : in_sweep);
  if (contradict(in_scene, in_sweep)) settings.replaced.back().is_surplus = true;
  if (!by_axis) settings.replaced.back().values = swept->numbers().size();
  std::erase_if(by_axis ? settings.values : settings.axes,
                [key = key_of_scene(settings, parameter)](const Setting& setting) { return setting.key == key; });
}

/// Lets a parameter of the command line replace another one of the file.
void replace(Settings& settings, Parameter by, Parameter replaced) {
  const Setting *const given = settings.given(by), *const former = settings.given(replaced);
  if (!from_command_line(given) || !from_file(former)) return;
  note(settings, replaced, given->key_location, former->key_location);
  remove(settings, replaced);
}

/// Makes `linked` and `follow` name an axis by its new key.
void rename(Settings& settings, Parameter from, Parameter to) {
  for (Setting& setting : settings.values) {
    if (setting.key->kind != Kind::names || setting.key->section != "sweep") continue;
    std::vector<std::string> names = split_names(std::get<std::string>(setting.value));
    if (std::ranges::find(names, from.key()) == names.end()) continue;
    std::ranges::replace(names, std::string(from.key()), std::string(to.key()));
    setting.value = joined(std::vector<std::string_view>(names.begin(), names.end()));
  }
}

/// A key that sets a number of both stops, and the keys of each.
struct Pair {
  Parameter both;
  Parameter one, other;
};

/// The keys of [scene] and [machine] of which one stands for two others.
std::vector<Pair> pairs() {
  std::vector<Pair> found;
  for (const Parameter both : all_parameters) {
    if (!both.is_of_both() || both.row().is_with_unit) continue;
    std::vector<Parameter> halves;
    for (const Parameter half : all_parameters)
      if (both.stands_for(half) && !half.row().is_with_unit) halves.push_back(half);
    found.push_back({both, halves.at(0), halves.at(1)});
  }
  return found;
}

/// The number of one stop that a value of the common key sets.
double half_of(double value, const Pair& pair, Parameter half) {
  GivenScene given;
  set(given, pair.both, value);
  return value_of(given, half);
}

/// The keys of a machine that give its damping.
constexpr Parameter dampings[] = {"damping", "damping_ratio", "quality"};

/// Makes a setting of the pair's common key one of the remaining half.
void halve(Setting& setting, const Pair& pair, Parameter remaining, const Key* key_of_remaining) {
  std::vector<double> halves;
  for (const double number : setting.numbers()) halves.push_back(half_of(number, pair, remaining));
  setting.key = key_of_remaining;
  auto* const axis = std::get_if<AxisValues>(&setting.value);
  if (axis == nullptr) {
    setting.value = halves.front();
  } else if (halves != axis->values) {
    axis->text = toml_list(halves);
    axis->values = std::move(halves);
  }
}

void halve(Settings& settings, const Pair& pair, Parameter remaining) {
  for (auto* const list : {&settings.values, &settings.axes})
    for (Setting& setting : *list)
      if (setting.key == key_of_scene(settings, pair.both))
        halve(setting, pair, remaining, key_of_scene(settings, remaining));
  rename(settings, pair.both, remaining);
}

/// Lets the command line replace one half of a pair; the other keeps the file's value.
void replace_half(Settings& settings, const Pair& pair, Parameter by, Parameter remaining) {
  const Setting *const given = settings.given(by), *const former = settings.given(pair.both);
  if (!from_command_line(given) || !from_file(former)) return;
  if (settings.given(remaining)) return replace(settings, by, pair.both);
  note(settings, pair.both, given->key_location, former->key_location, ", which stays as " + quoted_name(remaining));
  halve(settings, pair, remaining);
}

/// The keys of the softness and the restitutions of a stop, or of a wall of a loose mass.
struct KeysOfStop {
  Parameter stiffness, soft_restitution;
  std::array<Parameter, 4> restitution;
};
constexpr KeysOfStop of_stops{"stop_stiffness", "stop_R", {"R", "R_exponent", "R_reference_speed", "R_below"}},
    of_walls{"loose_wall_stiffness",
             "loose_wall_R",
             {"loose_R", "loose_R_exponent", "loose_R_reference_speed", "loose_R_below"}};

/// A soft stop, or wall, has no restitution.
void let_soft_stop_or_restitution_win(Settings& settings, const KeysOfStop& keys, Side side) {
  const auto either = [side](Parameter both) {
    return std::array{both,
                      Parameter::of(std::string(both.key()) + (side == Side::lower ? "_lower" : "_upper")).value()};
  };
  for (const Parameter soft : either(keys.stiffness))
    for (const Parameter of_both : keys.restitution)
      for (const Parameter rigid : either(of_both)) {
        exclude(settings, soft, rigid);
        replace(settings, soft, rigid), replace(settings, rigid, soft);
        for (const Parameter of_soft : either(keys.soft_restitution)) replace(settings, rigid, of_soft);
      }
}

/// The damping of a soft stop is given in one of several ways.
void let_one_way_to_damp_stops_win(Settings& settings, const std::vector<Pair>& all) {
  std::vector<Pair> ways;
  std::ranges::copy_if(all, std::back_inserter(ways),
                       [](const Pair& pair) { return pair.both.role() == Role::stop_damping; });
  for (const Pair& way : ways)
    for (const Pair& other : ways) {
      if (way.both == other.both || way.both.is_loose() != other.both.is_loose()) continue;
      for (const Parameter by : {way.both, way.one, way.other})
        for (const Parameter former : {other.both, other.one, other.other})
          if (by.side() == former.side() || by.is_of_both() || former.is_of_both()) exclude(settings, by, former);
      for (const Parameter former : {other.both, other.one, other.other}) replace(settings, way.both, former);
      replace(settings, way.one, other.one), replace(settings, way.other, other.other);
      replace_half(settings, other, way.one, other.other), replace_half(settings, other, way.other, other.one);
    }
}

}  // namespace

void apply_overrides(ParsedConfig& parsed, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) {
    check_words(change);
    ParsedEntry entry = entry_of(change);
    const auto same = std::find_if(parsed.entries.begin(), parsed.entries.end(), [&](const ParsedEntry& other) {
      return other.section == entry.section && other.key == entry.key;
    });
    if (same == parsed.entries.end()) {
      parsed.entries.push_back(std::move(entry));
    } else {
      *same = std::move(entry);
    }
  }
}

void let_command_line_win(Settings& settings) {
  for (const Parameter parameter : all_parameters)
    if (!parameter.row().is_with_unit) choose_section(settings, parameter);
  const std::vector<Pair> all_pairs = pairs();
  for (const Pair& pair : all_pairs) {
    exclude(settings, pair.both, pair.one), exclude(settings, pair.both, pair.other);
    replace(settings, pair.both, pair.one), replace(settings, pair.both, pair.other);
    replace_half(settings, pair, pair.one, pair.other), replace_half(settings, pair, pair.other, pair.one);
  }
  constexpr Parameter alike("stop_amplitude");  // of both, in a frame that moves with them
  for (const Parameter apart : {Parameter("stop_amplitude_lower"), Parameter("stop_amplitude_upper")})
    exclude(settings, alike, apart), replace(settings, alike, apart), replace(settings, apart, alike);
  let_one_way_to_damp_stops_win(settings, all_pairs);
  for (const auto& [keys, is_soft] :
       {std::pair{of_stops, &is_soft_somewhere}, std::pair{of_walls, &is_soft_wall_somewhere}}) {
    const bool lower = is_soft(settings, Side::lower), upper = is_soft(settings, Side::upper);
    if (lower) let_soft_stop_or_restitution_win(settings, keys, Side::lower);
    if (upper) let_soft_stop_or_restitution_win(settings, keys, Side::upper);
  }
  let_speed_table_or_restitution_win(settings);
  let_force_table_or_force_win(settings);
  for (const Parameter one : dampings)
    for (const Parameter other : dampings)
      if (one.index() < other.index()) exclude(settings, one, other);
  for (const Parameter one : dampings)
    for (const Parameter other : dampings)
      if (one != other) replace(settings, one, other);
  constexpr Parameter start_period = "start_period", starts[] = {"x0", "v0"};
  for (const Parameter start : starts) exclude(settings, start_period, start);
  for (const Parameter start : starts) replace(settings, start_period, start), replace(settings, start, start_period);
}

std::string to_string(const Replaced& replaced) {
  return to_string(replaced.by) + " in place of " + in_quotes(replaced.key) + ", " + to_string(replaced.former) +
         replaced.remark;
}

}  // namespace clatter::config
