#include "config/settings.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

void check_section(const std::string& name, const SourceLocation& location) {
  const auto known = sections();
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near(nearest(name, known));
  fail(location, "unknown section [" + name + "]" +
                     (near.empty() ? "; permitted: " + joined(known) : "; did you mean [" + near + "]?"));
}

std::string shown(std::string_view section) {
  return section.empty() ? "before the first section" : "in [" + std::string(section) + "]";
}

/// The right place of a key that stands in the wrong section, for a message.
std::string home_of(std::string_view name) {
  for (const std::string_view section : sections()) {
    if (section == name) return "; begin the section with [" + std::string(name) + "]";
  }
  for (const Key& key : keys()) {
    if (key.name == name) return "; it belongs " + shown(key.section);
  }
  return {};
}

/// [[sweep]] in place of [sweep].
void check_brackets(const ParsedEntry& entry) {
  const auto known = sections();
  const auto* const list = std::get_if<ParsedList>(&entry.value.data);
  if (!entry.section.empty() || list == nullptr || list->empty()) return;
  if (!std::holds_alternative<Unsupported>(list->front().data)) return;
  if (std::find(known.begin(), known.end(), entry.key) == known.end()) return;
  fail(entry.location, "[[" + entry.key + "]] begins a list of tables, a section is one table; write [" + entry.key +
                           "], in single brackets");
}

const Key& known_key(const ParsedEntry& entry) {
  if (const Key* const key = find_key(entry.section, entry.key)) return *key;
  const std::vector<std::string_view> names = key_names(entry.section);
  std::string way_out = nearest(entry.key, names).empty() ? home_of(entry.key) : "";
  if (way_out.empty()) way_out = suggestion(entry.key, names, "; permitted: ");
  fail(entry.location, "unknown key " + in_quotes(entry.key) + ' ' + shown(entry.section) + way_out);
}

/// A setting as if it were written in INI.
Setting setting_of(const Key& key, std::string_view value) {
  return {&key, convert(key, {std::string(value), {"the table of keys"}, true, 0}), {}, {}};
}

template <typename Value>
Value value_of(const Settings& settings, std::string_view section, std::string_view name) {
  const Setting* const given = settings.find(section, name);
  if (given != nullptr) return std::get<Value>(given->value);
  const Key* const key = find_key(section, name);
  if (key == nullptr) throw std::logic_error("no key " + std::string(section) + '.' + std::string(name));
  return std::get<Value>(default_setting(*key).value);
}

}  // namespace

const Setting* Settings::find(std::string_view section, std::string_view name) const {
  for (const Setting& setting : values) {
    if (setting.key->section == section && setting.key->name == name) return &setting;
  }
  return nullptr;
}

std::optional<Given> Settings::given(sweep::Parameter parameter) const {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const SweptSetting& swept = axes[i];
    if (swept.parameter == parameter)
      return Given{swept.axis.values, swept.axis.locations, swept.key_location, swept.location, i};
  }
  const Setting* const fixed = find("scene", key_of(parameter));
  if (fixed == nullptr) return std::nullopt;
  return Given{{&std::get<double>(fixed->value), 1}, {}, fixed->key_location, fixed->location, std::nullopt};
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

SourceLocation Settings::place_of_section(std::string_view name) const {
  for (const ParsedSection& section : sections) {
    if (section.name == name) return section.location;
  }
  return {file, 1, 1};
}

Setting default_setting(const Key& key) { return setting_of(key, key.fallback); }

Setting example_setting(const Key& key) { return setting_of(key, key.example); }

Settings check_keys(ParsedConfig raw) {
  Settings settings{std::move(raw.file), std::move(raw.sections), {}, {}, {}};
  for (const ParsedSection& section : settings.sections) check_section(section.name, section.location);
  for (const ParsedEntry& entry : raw.entries) {
    check_section(entry.section, entry.location);
    check_brackets(entry);
    const Key& key = known_key(entry);
    if (entry.section == "sweep" && key.section == "scene") {
      settings.axes.push_back({sweep::parameter_of(key.name).value(), convert_axis(key, entry.value), entry.location,
                               entry.value.location});
    } else {
      settings.values.push_back({&key, convert(key, entry.value), entry.location, entry.value.location});
    }
  }
  return settings;
}

}  // namespace clatter::config
