#include "config/keys.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "branches/settings.hpp"
#include "config/force_keys.hpp"
#include "config/suggestion.hpp"
#include "config/unit.hpp"
#include "config/value_grammar.hpp"
#include "observables/all.hpp"
#include "scene/parameter.hpp"
#include "scene/shaking.hpp"
#include "stepping/integration.hpp"
#include "sweep/sweep.hpp"

namespace clatter::config {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using ranges::not_negative, ranges::zero_to_one;

constexpr std::array<std::string_view, 2> modes{"steady", "transient"};
constexpr std::array<std::string_view, 2> effects{"required", "all"};

using enum Kind;

constexpr std::string_view a_stop_axis = "xs = \"linspace(1, 2, 11)\"\n", is_transient = "mode = \"transient\"\n",
                           by_moreau = "method = \"moreau\"\n", a_range = "range = [0.8, 1.5]\n",
                           a_branch = "along = \"nu\"\nrange = [0.8, 1.5]\n",
                           a_kind = "along = \"nu\"\nrange = [0.8, 1.5]\ncurve = \"fold\"\n",
                           a_second = "along = \"nu\"\nrange = [0.8, 1.5]\nacross = \"xs\"\n",
                           a_curve = "along = \"nu\"\nrange = [0.8, 1.5]\nacross = \"xs\"\ncurve = \"fold\"\n";

constexpr std::array keys_of_file{
    Key{"", "title", text, "", "My sweep", "title of the configuration, which pictures and the output file bear"},
    Key{"", "source", text, "", "doi:10.5755/j02.mech.32277",
        "origin of the configuration, e.g. a DOI, kept in the output file"},
};

/// A speed of one side, and the lines beside which it has an effect: the exponent of that side is enough.
struct BesideOfHalf {
  std::string_view key, in_scene, in_machine;
};
constexpr std::array beside_of_halves{
    BesideOfHalf{"R_reference_speed_lower", "xs = 1.0\nR = 0.7\nR_exponent_lower = 0.2\n",
                 "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nR = 0.7\nR_exponent_lower = 0.2\n"},
    BesideOfHalf{"R_reference_speed_upper", "xs = 1.0\nR = 0.7\nR_exponent_upper = 0.2\n",
                 "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nR = 0.7\nR_exponent_upper = 0.2\n"},
    BesideOfHalf{"loose_R_reference_speed_lower",
                 "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\nloose_R_exponent_lower = 0.2\n",
                 "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n"
                 "loose_R = 0.6\nloose_R_exponent_lower = 0.2\n"},
    BesideOfHalf{"loose_R_reference_speed_upper",
                 "f = 0.3\nnu = 1.3\nloose_mass = 0.05\nloose_gap = 1.9\nloose_R = 0.6\nloose_R_exponent_upper = 0.2\n",
                 "mass = 0.25\nstiffness = 800.0\nforce = 4.0\nfrequency = 9.0\nloose_mass = 0.01\nloose_gap = 8e-3\n"
                 "loose_R = 0.6\nloose_R_exponent_upper = 0.2\n"}};

/// The key of a parameter in one of the sections that describe a scene. In [scene] nothing but an angle has a unit.
Key key_of(Parameter parameter, bool is_si) {
  const auto& row = parameter.row();
  const KeyText& words = is_si ? row.in_machine : row.in_scene;
  Key key{is_si ? "machine" : "scene", row.key, number, words.fallback, words.example, words.help, row.range};
  key.other = row.other, key.beside = words.beside;
  for (const auto& [name, in_scene, in_machine] : beside_of_halves)
    if (row.key == name) key.beside = is_si ? in_machine : in_scene;
  if (is_si || row.quantity == Quantity::angle) key.quantity = row.quantity;
  for (const Parameter other : all_parameters) {
    if (is_si && other.key() == row.other && !other.is_in("machine")) key.other = other.row().counterpart;
    if (is_si && other.key() == row.key && other.row().is_with_unit) key.with_unit = other.row().quantity;
  }
  return key;
}

/// A table of restitution by speed, and the key that it takes the place of.
struct TableKey {
  std::string_view name, help, restitution;
};
constexpr std::array keys_of_tables{
    TableKey{"R_of_speed",
             "restitution by impact speed, in place of R: speeds and their R, straight lines between, constant beyond",
             "R"},
    TableKey{"R_of_speed_lower", "restitution of the lower stop by impact speed, in place of R_lower", "R_lower"},
    TableKey{"R_of_speed_upper", "restitution of the upper stop by impact speed, in place of R_upper", "R_upper"},
    TableKey{"loose_R_of_speed",
             "restitution of the loose mass by its speed in the housing, in place of loose_R: speeds and their R, "
             "straight lines between, constant beyond",
             "loose_R"},
    TableKey{"loose_R_of_speed_lower", "restitution of the lower wall by speed, in place of loose_R_lower",
             "loose_R_lower"},
    TableKey{"loose_R_of_speed_upper", "restitution of the upper wall by speed, in place of loose_R_upper",
             "loose_R_upper"}};

Key key_of(const TableKey& table, Parameter restitution, bool is_si) {
  const auto& row = restitution.row();
  Key key{is_si ? "machine" : "scene", table.name, text, "", "0: 0.9, 0.5: 0.8, 2: 0.6", table.help};
  if (is_si) key.example = "0: 0.9, 0.5 m/s: 0.8, 2 m/s: 0.6";
  key.other = table.restitution, key.beside = (is_si ? row.in_machine : row.in_scene).beside;
  return key;
}

/// The keys along which a motion can be followed: none is the friction of a loose mass, of a force in pieces, or of the
/// motion of one stop by itself.
std::vector<std::string_view> keys_to_follow() {
  std::vector<std::string_view> keys;
  for (const Parameter parameter : all_parameters) {
    const bool is_its_friction = parameter.is_loose() && parameter.role() == Role::friction;
    if (parameter.role() != Role::start && parameter.role() != Role::force_shape &&
        parameter.role() != Role::stop_motion && !parameter.row().is_with_unit && !is_its_friction)
      keys.push_back(parameter.key());
  }
  return keys;
}
const std::vector<std::string_view> followed_names = keys_to_follow();

constexpr std::array keys_before_observe{
    with("xs = [1.0, 2.0]\nR = [0.7, 0.5]\n",
         Key{"sweep", "linked", names, "", "xs, R",
             "axes of equal length that run together instead of crossing, e.g. nu, f; the first names the dimension"}),
    with(a_stop_axis,
         Key{"sweep", "follow", names, "", "xs",
             "axis (or linked axes) along which each point starts from the final state of the one before"}),
    with(
        "xs = \"linspace(1, 2, 11)\"\nfollow = \"xs\"\n",
        one_of(sweep::direction_names,
               Key{"sweep", "direction", choice, "up", "both",
                   "up: follow the axis in its order; down: from its end; both: up, then down from where that ended"})),

    with("duration = 63.0\n",
         one_of(modes,
                Key{"time", "mode", choice, "steady", "transient",
                    "steady: run until the motion repeats, observe one period; transient: observe from tau = 0"})),
    Key{"time", "max_periods", integer, "5000", "1000", "steady: give up settling after so many forcing periods",
        AllowedRange{.low = 1, .high = 1e12}},
    Key{"time", "window", integer, "64", "16", "steady: forcing periods to observe if the motion doesn't repeat",
        AllowedRange{.low = 1, .high = 1e9}},
    with(is_transient,
         of(Quantity::time,
            Key{"time", "duration", number, "0", "63",
                "transient: time to observe, in tau, with [machine] in s; needed there, and above 0", not_negative})),
    Key{"time", "tolerance", number, "1e-12", "1e-9",
        "steady: two states count as a repeat if they are closer than this",
        AllowedRange{.low = 0, .high = 1, .open = true}},
    Key{"time", "max_impacts", integer, "1e8", "1e6",
        "give up a point after so many impacts, with the status event_budget", AllowedRange{.low = 1, .high = 1e15}},
};

const std::array keys_after_observe{
    with("[scene]\nbase_amplitude = 0.1\n\n[observe]\nextrema = true\n",
         one_of(frame_names, Key{"observe", "frame", choice, "relative", "absolute",
                                 "frame of displacements and velocities if stops or base are shaken: relative to them, "
                                 "or absolute; impact speeds, energies, x0 and v0 stay relative"})),
    one_of(stepping::method_names,
           Key{"integrator", "method", choice, "exact", "dopri5",
               "exact: closed form, every contact proved to be the first; for comparison, dopri5: Dormand-Prince pair "
               "of orders 5 and 4, contacts on its dense output; moreau: Moreau-Jean time stepping"}),
    with("method = \"dopri5\"\n", Key{"integrator", "tolerance", number, "1e-10", "1e-8",
                                      "dopri5: error of a step, relative to the expected size of the motion",
                                      AllowedRange{.low = 1e-14, .high = 0.1}}),
    with(by_moreau, Key{"integrator", "step", number, "1e-3", "1e-4",
                        "moreau: time step in forcing periods, without a force in units of 2 pi",
                        AllowedRange{.low = 1e-9, .high = 1}}),
    with(by_moreau, Key{"integrator", "theta", number, "0.5", "1",
                        "moreau: weight of a step's end; 1/2: the trapezoidal rule, 1: implicit Euler; below 1/2 "
                        "stable only for short steps",
                        zero_to_one}),
    one_of(effects, Key{"integrator", "effects", choice, "required", "all",
                        "required: simulate only the effects that a scene calls for; all: for comparison, simulate "
                        "every effect for max_periods, and look for a repeat only then"}),

    with(a_range,
         one_of(followed_names,
                Key{"branch", "along", choice, "", "nu",
                    "parameter, by its key in [scene] or [machine], along which `clatter branch` follows a motion"})),
    with("along = \"nu\"\n",
         Key{"branch", "range", interval, "", "0.8, 1.5", "range of that parameter; branches end at its limits"}),
    with(a_kind, one_of(followed_names, Key{"branch", "across", choice, "", "xs",
                                            "second parameter: special points are followed in the plane of the two"})),
    with(a_curve, Key{"branch", "across_range", interval, "", "0.5, 4",
                      "range of the second parameter; without it, all values that are permitted"}),
    with(a_second, one_of(branches::curve_names,
                          Key{"branch", "curve", choice, "", "fold", "kind of special point to follow in that plane"})),
    with(a_branch, Key{"branch", "period", integer, "0", "2",
                       "forcing periods of the motion near x0, v0 to start from, stable or not; 0: start from the "
                       "motion that the scene settles on",
                       AllowedRange{.low = 0, .high = 64}}),
    with(a_branch, Key{"branch", "tolerance", number, "1e-12", "1e-10", "relative tolerance of Newton's method",
                       AllowedRange{.low = 1e-14, .high = 1e-3}}),
    with(a_branch, Key{"branch", "largest_step", number, "0.02", "0.01",
                       "largest step along the branch, relative to the width of the range",
                       AllowedRange{.low = 1e-6, .high = 1}}),
    with(a_branch, Key{"branch", "max_points", integer, "10000", "1000", "give up following after so many points",
                       AllowedRange{.low = 2, .high = 1e7}}),
    with(a_branch,
         Key{"branch", "switch", integer, "0", "2",
             "follow branches born at flips and symmetry breakings, and those born on them, this many times over",
             AllowedRange{.low = 0, .high = 20}}),
    with(a_branch,
         one_of(branches::birth_names,
                Key{"branch", "births", choices, "", "flip, graze",
                    "births that are followed, flips and losses of symmetry as often as 'switch' says; a motion that "
                    "goes on beyond a graze is always followed"})),

    Key{"output", "compression", integer, "0", "4", "deflate level of the output file; 0: none",
        AllowedRange{.low = 0, .high = 9}},
};

/// The key of a parameter, behind the restitution of a stop its tables by speed, and before the shares of the parts of
/// a force its shape and its table.
void add_scene_key(Parameter parameter, bool is_si, std::vector<Key>& keys) {
  if (parameter == "force_duty") {
    keys.push_back(force_shape_key(is_si)), keys.push_back(force_table_key(is_si));
    keys.push_back(force_table_harmonics_key(is_si));
  }
  keys.push_back(key_of(parameter, is_si));
  for (const TableKey& table : keys_of_tables)
    if (table.restitution == parameter.key()) keys.push_back(key_of(table, parameter, is_si));
}

/// The keys of [observe] are those of the observables.
const std::vector<Key> all_keys = [] {
  std::vector<Key> keys;
  const auto add = [&](std::span<const Key> some) { keys.insert(keys.end(), some.begin(), some.end()); };
  add(keys_of_file);
  for (const bool is_si : {false, true})
    for (const Parameter parameter : all_parameters)
      if (parameter.is_in(is_si ? "machine" : "scene") && !parameter.row().is_with_unit)
        add_scene_key(parameter, is_si, keys);
  add(keys_before_observe);
  add(observables::All::keys()), add(keys_after_observe);
  return keys;
}();

constexpr std::array<std::string_view, 8> all_sections{"scene",   "machine",    "sweep",  "time",
                                                       "observe", "integrator", "branch", "output"};

/// A bound in the usual notation: 1e9, not 1e+09, and 1e-9, not 1e-09.
std::string bound_text(double bound) {
  if (bound == 2 * std::numbers::pi) return "2*pi";
  std::string number = number_text(bound);
  const std::size_t at = number.find('e');
  if (at == std::string::npos) return number;
  if (number[at + 2] == '0') number.erase(at + 2, 1);
  if (number[at + 1] == '+') number.erase(at + 1, 1);
  return number;
}

std::string describe(const AllowedRange& range) {
  if (range.infinite && range.low == -infinity) return "any number, -inf or inf";
  if (range.infinite) return "> " + bound_text(range.low) + " or inf";
  if (range.not_zero) return "any number but 0";
  if (range.low == -infinity) return "any number";
  const std::string low = bound_text(range.low);
  const std::string zero = range.or_zero ? "0 or " : "";
  if (range.high == infinity) return zero + (range.open ? "> " : ">= ") + low;
  const std::string high = bound_text(range.high);
  if (range.open) return (range.or_zero ? ">= " : "> ") + low + " and < " + high;
  return range.above ? "> " + low + " and <= " + high : zero + low + " ... " + high;
}

}  // namespace

std::span<const Key> keys() { return all_keys; }

std::span<const std::string_view> sections() { return all_sections; }

bool describes_scene(std::string_view section) { return section == "scene" || section == "machine"; }

const Key* find_key(std::string_view section, std::string_view name) {
  for (const Key& key : all_keys) {
    const bool axis = section == "sweep" && describes_scene(key.section);
    if (key.name == name && (key.section == section || axis)) return &key;
  }
  return nullptr;
}

std::vector<std::string_view> key_names(std::string_view section) {
  std::vector<std::string_view> names_of_section;
  for (const Key& key : all_keys) {
    const bool is_no_axis = section == "sweep" && describes_scene(key.section) && key.kind != number;
    if (find_key(section, key.name) == &key && !is_no_axis) names_of_section.push_back(key.name);
  }
  return names_of_section;
}

bool is_free_text(std::string_view section, std::string_view name) {
  const Key* const key = find_key(section, name);
  return key != nullptr && key->kind == text;
}

bool contains(const AllowedRange& range, double value) {
  if (std::isinf(value)) return range.infinite && (value > 0 || range.low == -infinity);
  if (value == 0 && range.or_zero) return true;
  if (value == 0 && range.not_zero) return false;
  if (range.open) return value > range.low && value < range.high;
  return (range.above ? value > range.low : value >= range.low) && value <= range.high;
}

std::string permitted(const Key& key) {
  switch (key.kind) {
    case text:
      return "text";
    case names:
      return key.section == "sweep" ? "names of axes" : "keys of the scene, but no starts";
    case flag:
      return "true or false";
    case choice:
      return joined(key.choices);
    case choices:
      return "some of " + joined(key.choices) + ", or " + std::string(no_choice);
    case integer:
      return "a whole number, " + describe(key.range);
    case interval:
      return "two numbers, the lower first";
    case number:
      break;
  }
  const bool has_unit = key.section == "machine" && key.quantity != Quantity::number;
  return describe(key.range) + (has_unit ? ", in " + std::string(unit_of_numbers(key.quantity)) : "");
}

}  // namespace clatter::config
