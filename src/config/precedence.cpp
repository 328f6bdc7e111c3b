#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "config/consistency.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

using enum sweep::Parameter;

std::string quoted_name(sweep::Parameter parameter) { return in_quotes(key_of(parameter)); }

/// Whether a location comes after another one of the same origin.
bool later(const SourceLocation& left, const SourceLocation& right) {
  return std::tie(left.line, left.column) > std::tie(right.line, right.column);
}

/// Two locations contradict if both are in the file or both on the command line; otherwise the command line decides.
bool contradict(const SourceLocation& one, const SourceLocation& other) {
  return on_command_line(one) == on_command_line(other);
}

/// Refuses two keys that say the same, at the one that was written last.
void exclude(const Settings& settings, sweep::Parameter one, sweep::Parameter other) {
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
const Key* key_of_scene(const Settings& settings, sweep::Parameter parameter) {
  return find_key(settings.scene_section, key_of(parameter));
}

/// Removes the file's setting of a parameter from the scene's section or [sweep].
void remove(Settings& settings, sweep::Parameter parameter) {
  for (auto* const list : {&settings.values, &settings.axes})
    std::erase_if(*list, [&](const Setting& setting) {
      return setting.key == key_of_scene(settings, parameter) && !on_command_line(setting.key_location);
    });
}

void note(Settings& settings, sweep::Parameter parameter, const SourceLocation& by, const SourceLocation& former,
          const std::string& remark = "") {
  settings.replaced.push_back({parameter, by, former, remark});
}

/// Lets the command line's setting of a parameter, in the scene's section or [sweep], replace that of the other section
/// in the file.
void choose_section(Settings& settings, sweep::Parameter parameter) {
  const Setting* const fixed = settings.find(settings.scene_section, key_of(parameter));
  const auto swept = std::ranges::find(settings.axes, key_of_scene(settings, parameter), &Setting::key);
  if (fixed == nullptr || swept == settings.axes.end()) return;
  const SourceLocation in_scene = fixed->key_location, in_sweep = swept->key_location;
  if (contradict(in_scene, in_sweep))
    fail(later(in_scene, in_sweep) ? in_scene : in_sweep,
         quoted_name(parameter) + " in both [" + std::string(settings.scene_section) +
             "] and [sweep]; remove one of them (for a single value: sweep." + std::string(key_of(parameter)) +
             " = VALUE)");
  const bool by_axis = on_command_line(in_sweep);
  note(settings, parameter, by_axis ? in_sweep : in_scene, by_axis ? in_scene : in_sweep);
  remove(settings, parameter);
}

/// Lets a parameter of the command line replace another one of the file.
void replace(Settings& settings, sweep::Parameter by, sweep::Parameter replaced) {
  const Setting *const given = settings.given(by), *const former = settings.given(replaced);
  if (!from_command_line(given) || !from_file(former)) return;
  note(settings, replaced, given->key_location, former->key_location);
  remove(settings, replaced);
}

/// Makes `linked` and `follow` name an axis by its new key.
void rename(Settings& settings, sweep::Parameter from, sweep::Parameter to) {
  for (Setting& setting : settings.values) {
    if (setting.key->kind != Kind::names) continue;
    std::vector<std::string> names = split_names(std::get<std::string>(setting.value));
    if (std::ranges::find(names, key_of(from)) == names.end()) continue;
    std::ranges::replace(names, std::string(key_of(from)), std::string(key_of(to)));
    setting.value = joined(std::vector<std::string_view>(names.begin(), names.end()));
  }
}

/// A key that sets two values and the key of each; `half` derives one of these from the common value.
struct Pair {
  sweep::Parameter both;
  sweep::Parameter one, other;
  double (*half)(sweep::Parameter, double);
};

double same(sweep::Parameter, double value) { return value; }
double stop_of(sweep::Parameter side, double xs_value) {
  return side == stop_lower ? -std::abs(xs_value) : std::abs(xs_value);
}

constexpr Pair pairs[] = {{xs, stop_lower, stop_upper, stop_of},
                          {gap, stop_lower, stop_upper, stop_of},
                          {R, R_lower, R_upper, same},
                          {stop_stiffness, stop_stiffness_lower, stop_stiffness_upper, same},
                          {stop_damping, stop_damping_lower, stop_damping_upper, same}};

/// The keys of a machine that give its damping.
constexpr sweep::Parameter dampings[] = {damping, damping_ratio, quality};

/// Makes a setting of the pair's common key one of the remaining half.
void halve(Setting& setting, const Pair& pair, sweep::Parameter remaining, const Key* key_of_remaining) {
  std::vector<double> halves;
  for (const double number : setting.numbers()) halves.push_back(pair.half(remaining, number));
  setting.key = key_of_remaining;
  auto* const axis = std::get_if<AxisValues>(&setting.value);
  if (axis == nullptr) {
    setting.value = halves.front();
  } else if (halves != axis->values) {
    axis->text = toml_list(halves);
    axis->values = std::move(halves);
  }
}

void halve(Settings& settings, const Pair& pair, sweep::Parameter remaining) {
  for (auto* const list : {&settings.values, &settings.axes})
    for (Setting& setting : *list)
      if (setting.key == key_of_scene(settings, pair.both))
        halve(setting, pair, remaining, key_of_scene(settings, remaining));
  rename(settings, pair.both, remaining);
}

/// Lets the command line replace one half of a pair; the other keeps the file's value.
void replace_half(Settings& settings, const Pair& pair, sweep::Parameter by, sweep::Parameter remaining) {
  const Setting *const given = settings.given(by), *const former = settings.given(pair.both);
  if (!from_command_line(given) || !from_file(former)) return;
  if (settings.given(remaining)) return replace(settings, by, pair.both);
  note(settings, pair.both, given->key_location, former->key_location, ", which stays as " + quoted_name(remaining));
  halve(settings, pair, remaining);
}

/// A soft stop has no restitution.
void let_soft_stop_or_restitution_win(Settings& settings, Side side) {
  const bool lower = side == Side::lower;
  for (const sweep::Parameter soft : {stop_stiffness, lower ? stop_stiffness_lower : stop_stiffness_upper})
    for (const sweep::Parameter rigid : {R, lower ? R_lower : R_upper}) {
      exclude(settings, soft, rigid);
      replace(settings, soft, rigid), replace(settings, rigid, soft);
    }
}

}  // namespace

void let_command_line_win(Settings& settings) {
  for (int parameter = 0; parameter <= static_cast<int>(start_period); ++parameter)
    choose_section(settings, static_cast<sweep::Parameter>(parameter));
  for (const Pair& pair : pairs) {
    exclude(settings, pair.both, pair.one), exclude(settings, pair.both, pair.other);
    replace(settings, pair.both, pair.one), replace(settings, pair.both, pair.other);
    replace_half(settings, pair, pair.one, pair.other), replace_half(settings, pair, pair.other, pair.one);
  }
  for (const Side side : {Side::lower, Side::upper})
    if (is_soft_somewhere(settings, side)) let_soft_stop_or_restitution_win(settings, side);
  for (const sweep::Parameter one : dampings)
    for (const sweep::Parameter other : dampings)
      if (one < other) exclude(settings, one, other);
  for (const sweep::Parameter one : dampings)
    for (const sweep::Parameter other : dampings)
      if (one != other) replace(settings, one, other);
  for (const sweep::Parameter start : {x0, v0}) exclude(settings, start_period, start);
  for (const sweep::Parameter start : {x0, v0})
    replace(settings, start_period, start), replace(settings, start, start_period);
}

std::string to_string(const Replaced& replaced) {
  return to_string(replaced.by) + " in place of " + quoted_name(replaced.parameter) + ", " +
         to_string(replaced.former) + replaced.remark;
}

}  // namespace clatter::config
