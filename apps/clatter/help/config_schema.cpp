#include "help/config_schema.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "config/axis_functions.hpp"
#include "config/keys.hpp"
#include "config/reference.hpp"
#include "config/settings.hpp"
#include "config/unit.hpp"

namespace clatter::app {
namespace {

using Json = nlohmann::ordered_json;

/// One of several texts, as a regular expression; of a symbol like * it is that itself.
template <class Range>
std::string any_of(const Range& names) {
  std::string text;
  for (const auto& named : names) (text += text.empty() ? "" : "|") += named;
  return "(" + text + ")";
}

const std::string number_pattern = R"([-+]?(pi|inf|[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?|\.[0-9]+([eE][-+]?[0-9]+)?))",
                  product = number_pattern + "( *[*/] *" + number_pattern + ")*";

/// A unit by its form: symbols with prefixes and powers.
std::string unit() {
  std::vector<std::string_view> with, without, prefixes;
  for (const config::Symbol& symbol : config::unit_symbols())
    (symbol.takes_prefix ? with : without).push_back(symbol.name);
  for (const config::Prefix& prefix : config::unit_prefixes()) prefixes.push_back(prefix.name);
  const std::string factor = "(" + any_of(prefixes) + "?" + any_of(with) + "|" + any_of(without) + R"()(\^?-?[1-4])?)";
  return "(1? */ *)?" + factor + "( *[ */] *" + factor + ")*";
}

/// A number as a text, in quotes: a product with pi, or one in % or, of a quantity, in a unit.
std::string measure(bool has_unit) {
  const std::string with_pi = "(" + number_pattern + R"( *[*/] *)*[-+]?pi( *[*/] *)" + number_pattern + ")*";
  return "(" + with_pi + "|" + product + " *" + (has_unit ? "(" + unit() + ")" : "%") + ")";
}

/// A number with its unit as an argument of a function, or between commas, where it may be a plain number.
std::string argument(bool has_unit) { return " *(" + product + "|" + measure(has_unit) + ") *"; }

/// The values of an axis as a text: a function, or a list.
std::string several(bool has_unit) {
  const std::string one = argument(has_unit);
  return " *" + any_of(config::axis_function_names()) + R"( *\()" + one + "," + one + "," + one + R"(\) *|\[?)" + one +
         "(," + one + R"()*\]?)";
}

Json text(const std::string& pattern) { return {{"type", "string"}, {"pattern", "^(" + pattern + ")$"}}; }

/// The texts, by which names the keys refer to them.
Json definitions() {
  return {{"number", text(measure(false))},
          {"quantity", text(measure(true))},
          {"numbers", text(several(false))},
          {"quantities", text(several(true))}};
}

Json reference(const char* name) { return {{"$ref", "#/definitions/" + std::string(name)}}; }

/// A key's number may have a unit if it is a quantity, as with_unit of some of [machine], or may be one in [branch].
bool may_have_unit(const Key& key) {
  return key.quantity != Quantity::number || key.with_unit != Quantity::number || key.kind == Kind::interval;
}

void limit(Json& json, const AllowedRange& range) {
  if (std::isfinite(range.low)) json[range.open || range.above ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) json[range.open ? "exclusiveMaximum" : "maximum"] = range.high;
  if (range.not_zero) json["not"] = {{"const", 0}};
}

/// A number within its range, or a text that stands for one.
Json number_or_text(const Key& key) {
  Json in_range{{"type", "number"}};
  limit(in_range, key.range);
  Json any = Json::array({in_range, reference(may_have_unit(key) ? "quantity" : "number")});
  if (key.range.or_zero) any.push_back({{"const", 0}});
  return any;
}

Json integer(const Key& key) {
  Json in_range{{"type", "integer"}};
  limit(in_range, key.range);
  if (!key.range.or_zero) return in_range;
  return {{"anyOf", Json::array({in_range, {{"const", 0}}})}};
}

/// The value of a key.
Json value(const Key& key) {
  switch (key.kind) {
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::choice:
      return {{"enum", key.choices}};
    case Kind::integer:
      return integer(key);
    case Kind::number:
      return {{"anyOf", number_or_text(key)}};
    case Kind::interval: {
      const Json end{{"anyOf", number_or_text(key)}};
      return {{"type", "array"}, {"items", end}, {"minItems", 2}, {"maxItems", 2}};
    }
    case Kind::choices:
      return {{"anyOf", Json::array({{{"type", "array"}, {"items", {{"enum", key.choices}}}}, {{"type", "string"}}})}};
    case Kind::names:
      return {{"anyOf", Json::array({{{"type", "array"}, {"items", {{"type", "string"}}}}, {{"type", "string"}}})}};
    case Kind::text:
      break;
  }
  return {{"type", "string"}};
}

/// The default as TOML has it: a flag, a number, or a text.
Json default_of(const Key& key) {
  const config::Value fallback = config::default_setting(key).value;
  if (const auto* const flag = std::get_if<bool>(&fallback)) return *flag;
  if (const auto* const whole = std::get_if<std::int64_t>(&fallback)) return *whole;
  if (const auto* const real = std::get_if<double>(&fallback)) return *real;
  return std::get<std::string>(fallback);
}

Json described(Json json, const Key& key) {
  json["description"] = std::string(key.help) + " (" + config::permitted_and_default(key) + ")";
  if (!key.has_default()) return json;
  Json fallback = default_of(key);
  if (!fallback.is_number_float() || std::isfinite(fallback.get<double>())) json["default"] = std::move(fallback);
  return json;
}

/// The values of an axis: a list, or a text that is a function, a list or a number.
Json axis(const Key& key) {
  Json any = number_or_text(key);
  any.push_back({{"type", "array"}, {"items", {{"anyOf", number_or_text(key)}}}, {"minItems", 1}});
  any.push_back(reference(may_have_unit(key) ? "quantities" : "numbers"));
  return {{"anyOf", any}, {"description", "axis: " + std::string(key.help)}};
}

/// The value of a name in a section, which in [sweep] may be an axis of either description of the scene.
Json value_in(std::string_view section, std::string_view name) {
  const Key& key = *config::find_key(section, name);
  if (key.section == section) return described(value(key), key);
  const Key* const of_machine = config::find_key("machine", name);
  if (of_machine == nullptr || of_machine == &key) return axis(key);
  Json both{{"anyOf", Json::array({axis(key), axis(*of_machine)})}};
  return both;
}

Json section_schema(std::string_view section) {
  Json properties = Json::object();
  for (const std::string_view name : config::key_names(section))
    properties[std::string(name)] = value_in(section, name);
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

}  // namespace

std::string config_schema() {
  Json schema = section_schema(""), given{{"minProperties", 1}};
  for (const std::string_view section : config::sections())
    schema["properties"][std::string(section)] = section_schema(section);
  Json whole{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "configuration of clatter"}};
  whole.update(schema);
  whole["not"] = {{"description", "the scene is either in [scene] or in [machine]"},
                  {"required", {"scene", "machine"}},
                  {"properties", {{"scene", given}, {"machine", given}}}};
  whole["definitions"] = definitions();
  return whole.dump(2, ' ', true) + '\n';
}

}  // namespace clatter::app
