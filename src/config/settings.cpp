#include "config/settings.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/suggestion.hpp"
#include "config/unknown_key.hpp"

namespace clatter::config {
namespace {

void check_section(const std::string& name, const SourceLocation& location) {
  const auto known = sections();
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near(nearest(name, known));
  fail(location, "unknown section [" + name + "]" +
                     (near.empty() ? "; expected one of " + joined(known) : "; did you mean [" + near + "]?"));
}

/// Refuses [[sweep]] in place of [sweep].
void check_brackets(const ParsedEntry& entry) {
  const auto known = sections();
  const auto* const list = std::get_if<ParsedList>(&entry.value.data);
  if (!entry.section.empty() || list == nullptr || list->empty()) return;
  if (!std::holds_alternative<Unsupported>(list->front().data)) return;
  if (std::find(known.begin(), known.end(), entry.key) == known.end()) return;
  fail(entry.location, "[[" + entry.key + "]] begins a list of tables, a section is one table; write [" + entry.key +
                           "], in single brackets");
}

/// The key in the section that describes the scene, of which an axis is one. Throws ConfigError if it is one of the
/// other section.
const Key& key_of_section(const Key& key, const ParsedEntry& entry, std::string_view scene_section) {
  if (!describes_scene(key.section)) return key;
  if (const Key* const own = find_key(scene_section, entry.key)) return *own;
  const std::string other(key.section), own(scene_section), counterpart(counterpart_of(entry.key));
  fail(entry.location, in_quotes(entry.key) + " is a key of [" + other + "], and [" + own + "] describes this scene; " +
                           (counterpart.empty() ? "" : "vary " + in_quotes(counterpart) + ", or ") +
                           "write the scene in [" + other + ']');
}

const Key& known_key(const ParsedEntry& entry, std::string_view scene_section) {
  if (const Key* const key = find_key(entry.section, entry.key)) return key_of_section(*key, entry, scene_section);
  fail(entry.location, "unknown key " + in_quotes(entry.key) + ' ' + shown(entry.section) +
                           way_out_of_unknown_key(entry, scene_section));
}

const ParsedEntry* first_of(const ParsedConfig& parsed, std::string_view section) {
  const auto found = std::ranges::find(parsed.entries, section, &ParsedEntry::section);
  return found == parsed.entries.end() ? nullptr : &*found;
}

/// The section that describes the scene. Throws ConfigError if both have keys.
std::string_view section_of_scene(const ParsedConfig& parsed) {
  const ParsedEntry *const scene = first_of(parsed, "scene"), *const machine = first_of(parsed, "machine");
  if (scene != nullptr && machine != nullptr) {
    const bool in_order = on_command_line(machine->location) ||
                          (!on_command_line(scene->location) && scene->location.line < machine->location.line);
    const ParsedEntry &first = *(in_order ? scene : machine), &second = *(in_order ? machine : scene);
    fail(second.location, second.section + '.' + second.key + " beside " + first.section + '.' + first.key + ", " +
                              to_string(first.location) +
                              "; describe the scene either in [scene], without units, or in [machine], in SI");
  }
  const bool has_header = std::ranges::find(parsed.sections, "machine", &ParsedSection::name) != parsed.sections.end();
  const bool has_other = std::ranges::find(parsed.sections, "scene", &ParsedSection::name) != parsed.sections.end();
  return machine != nullptr || (scene == nullptr && has_header && !has_other) ? "machine" : "scene";
}

/// The key that `along` or `across` of [branch] names; nullptr if that isn't given, or names none at all. Throws
/// ConfigError if it is one of the section that doesn't describe the scene.
const Key* followed_key(const ParsedConfig& parsed, std::string_view chosen_by, std::string_view scene_section) {
  for (const ParsedEntry& entry : parsed.entries) {
    const auto* const name = std::get_if<std::string>(&entry.value.data);
    if (entry.section != "branch" || entry.key != chosen_by || name == nullptr) continue;
    if (const Key* const key = find_key(scene_section, *name)) return key;
    const std::string_view counterpart = counterpart_of(*name);
    const bool is_of_other = find_key("scene", *name) != nullptr || find_key("machine", *name) != nullptr;
    if (is_of_other)
      fail(entry.value.location, in_quotes(*name) + " is no key of [" + std::string(scene_section) +
                                     "], which describes this scene; " +
                                     (counterpart.empty() ? "expected one that is" : "take " + in_quotes(counterpart)));
  }
  return nullptr;
}

/// Refuses a range in a unit without the parameter that it is of, which alone has one.
void check_ranges(const ParsedConfig& parsed, const Settings& settings) {
  const auto find = [&](std::string_view name) {
    const auto is_it = [&](const ParsedEntry& entry) { return entry.section == "branch" && entry.key == name; };
    return std::ranges::find_if(parsed.entries, is_it);
  };
  const auto none = parsed.entries.end(), range = find("range"), across = find("across_range");
  if (range != none && is_measure(range->value) && find("along") == none) refuse_missing_along(settings);
  if (across != none && is_measure(across->value) && find("across") == none)
    refuse_missing_across(settings, across->key, across->location);
}

/// A key of [branch] that holds values of another key has its quantity, so that they may have its units.
Key with_quantity(Key key, const Key* along, const Key* across) {
  if (key.section != "branch") return key;
  const Key* const followed = key.name == "range" ? along : key.name == "across_range" ? across : nullptr;
  if (followed != nullptr) key.quantity = followed->quantity, key.with_unit = followed->with_unit;
  return key;
}

/// Whether numbers were written without a unit, and without pi, which says that they are in rad.
bool is_plain(const ParsedValue& written) {
  const auto* const list = std::get_if<ParsedList>(&written.data);
  if (list != nullptr) return std::ranges::all_of(*list, is_plain);
  const auto* const text = std::get_if<std::string>(&written.data);
  return text == nullptr || (!is_measure(written) && text->find("pi") == std::string::npos);
}

/// A setting with a value as written in INI.
Setting setting_of(const Key& key, std::string_view value) {
  return {.key = &key,
          .value = convert(key, {std::string(value), {"the table of keys"}, true, 0}),
          .key_location = {},
          .location = {}};
}

template <typename Type>
Type value_of(const Settings& settings, std::string_view section, std::string_view name) {
  const Setting* const given = settings.find(section, name);
  if (given != nullptr) return std::get<Type>(given->value);
  const Key* const key = find_key(section, name);
  if (key == nullptr) throw std::logic_error("no key " + std::string(section) + '.' + std::string(name));
  return std::get<Type>(default_setting(*key).value);
}

}  // namespace

std::span<const double> Setting::numbers() const {
  if (const auto* const axis = std::get_if<AxisValues>(&value)) return axis->values;
  return {&std::get<double>(value), 1};
}

const SourceLocation& Setting::location_of(std::size_t index) const {
  const auto* const axis = std::get_if<AxisValues>(&value);
  return axis != nullptr && index < axis->locations.size() ? axis->locations[index] : location;
}

const Setting* Settings::find(std::string_view section, std::string_view name) const {
  for (const Setting& setting : values) {
    if (setting.key->section == section && setting.key->name == name) return &setting;
  }
  return nullptr;
}

const Setting* Settings::given(Parameter parameter) const {
  for (const Setting& axis : axes) {
    if (axis.key->name == parameter.key()) return &axis;
  }
  return find(scene_section, parameter.key());
}

const Setting* Settings::given_symmetric_stops() const { return given(is_si() ? Parameter("gap") : Parameter("xs")); }

std::optional<Parameter> Settings::followed(std::string_view key) const {
  return find("branch", key) != nullptr ? Parameter::of(text("branch", key)) : std::nullopt;
}

std::string Settings::text(std::string_view section, std::string_view name) const {
  return value_of<std::string>(*this, section, name);
}

double Settings::number(std::string_view section, std::string_view name) const {
  return value_of<double>(*this, section, name);
}

std::int64_t Settings::integer(std::string_view section, std::string_view name) const {
  return value_of<std::int64_t>(*this, section, name);
}

bool Settings::flag(std::string_view section, std::string_view name) const {
  return value_of<bool>(*this, section, name);
}

Interval Settings::interval(std::string_view section, std::string_view name) const {
  return value_of<Interval>(*this, section, name);
}

SourceLocation Settings::location_of_section(std::string_view name) const {
  for (const ParsedSection& section : sections) {
    if (section.name == name) return section.location;
  }
  return {file, 1, 1};
}

Setting default_setting(const Key& key) { return setting_of(key, key.fallback); }

Setting example_setting(const Key& key) { return setting_of(key, key.example); }

std::string_view counterpart_of(std::string_view name) {
  const std::optional<Parameter> parameter = Parameter::of(name);
  return parameter ? parameter->row().counterpart : std::string_view{};
}

void refuse_missing_along(const Settings& settings) {
  fail(settings.location_of_section("branch"), "[branch] without 'along'; add a key of [" +
                                                   std::string(settings.scene_section) + "], e.g. along = \"" +
                                                   (settings.is_si() ? "frequency" : "nu") + '"');
}

void refuse_missing_across(const Settings& settings, std::string_view key, const SourceLocation& location) {
  fail(location, in_quotes(key) + " without 'across'; add the second parameter, e.g. across = \"" +
                     (settings.is_si() ? "gap" : "xs") + '"');
}

Settings check_keys(ParsedConfig parsed) {
  const std::string_view scene_section = section_of_scene(parsed);
  Settings settings{std::move(parsed.file), std::move(parsed.sections), {}, {}, {}, scene_section};
  for (const ParsedSection& section : settings.sections) check_section(section.name, section.location);
  const Key *const along = followed_key(parsed, "along", scene_section), *const across = followed_key(parsed, "across",
                                                                                                      scene_section);
  check_ranges(parsed, settings);
  for (const ParsedEntry& entry : parsed.entries) {
    check_section(entry.section, entry.location);
    check_brackets(entry);
    const Key& key = known_key(entry, scene_section);
    if (entry.section == "sweep" && describes_scene(key.section)) {
      settings.axes.push_back({&key, convert_axis(key, entry.value), entry.location, entry.value.location,
                               quantity_of(key, entry.value), is_plain(entry.value)});
    } else {
      const Key read_as = with_quantity(key, along, across);
      settings.values.push_back({&key, convert(read_as, entry.value, settings.is_si()), entry.location,
                                 entry.value.location, quantity_of(read_as, entry.value), is_plain(entry.value)});
    }
  }
  return settings;
}

}  // namespace clatter::config
