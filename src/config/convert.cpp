#include <algorithm>
#include <cmath>
#include <type_traits>

#include "config/axis_functions.hpp"
#include "config/comma.hpp"
#include "config/settings.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

/// Describes a written value, for a message.
std::string found(const ParsedValue& raw) {
  const auto describe = [](const auto& data) -> std::string {
    using Data = std::decay_t<decltype(data)>;
    if constexpr (std::is_same_v<Data, std::string>) return data.empty() ? "nothing" : "the text " + in_quotes(data);
    if constexpr (std::is_same_v<Data, bool>) return data ? "true" : "false";
    if constexpr (std::is_same_v<Data, std::int64_t>) return "the number " + std::to_string(data);
    if constexpr (std::is_same_v<Data, double>) return "the number " + number_text(data);
    if constexpr (std::is_same_v<Data, ParsedList>) return "a list";
    if constexpr (std::is_same_v<Data, Unsupported>) return data.name;
  };
  return std::visit(describe, raw.data);
}

/// "; expected 0 ... 1", "; expected one of fft, exact"
std::string expected(const Key& key) {
  return (key.kind == Kind::choice ? "; expected one of " : "; expected ") + permitted(key);
}

[[noreturn]] void wrong_kind(const Key& key, const ParsedValue& raw, const std::string& way_out = "") {
  fail(raw.location, std::string(key.name) + " = " + found(raw) + expected(key) + way_out);
}

/// Whether a text stands for several values.
bool is_axis(std::string_view text) {
  const auto names = axis_function_names();
  const bool calls = std::ranges::any_of(names, [&](std::string_view name) { return text.starts_with(name); });
  return calls || text.starts_with('[') || text.find(',') != std::string_view::npos;
}

/// Says where several values belong: those of a key of [scene] are an axis.
std::string home_of_axis(const Key& key, const ParsedValue& raw) {
  if (key.section != "scene") return "; one value, since only keys of [scene] can be axes";
  const auto* const text = std::get_if<std::string>(&raw.data);
  if (!on_command_line(raw.location) || text == nullptr)
    return "; several values are an axis, and its line belongs in [sweep]";
  return "; several values are an axis: --set sweep." + std::string(key.name) + "='" + *text + '\'';
}

/// Refuses several values, or a number with a comma, where one value is needed; the message says what to write.
void check_single(const Key& key, const ParsedValue& raw) {
  const auto* const text = std::get_if<std::string>(&raw.data);
  if (std::holds_alternative<ParsedList>(raw.data)) wrong_kind(key, raw, home_of_axis(key, raw));
  if (text != nullptr && is_axis(*text)) wrong_kind(key, raw, comma_hint(*text, key.kind) + home_of_axis(key, raw));
}

SourceText source_text(const std::string& text, const ParsedValue& raw) {
  SourceText source{text, raw.location, raw.untyped || raw.inset > 0};
  source.location.column += raw.inset;
  return source;
}

/// The number that was written; in TOML a text is one only if it holds pi, since "0.5" in quotes is a slip.
double number_of(const Key& key, const ParsedValue& raw) {
  if (const auto* const integer = std::get_if<std::int64_t>(&raw.data)) return static_cast<double>(*integer);
  if (const auto* const number = std::get_if<double>(&raw.data)) return *number;
  const auto* const text = std::get_if<std::string>(&raw.data);
  if (text == nullptr) wrong_kind(key, raw);
  if (!raw.untyped && text->find("pi") == std::string::npos)
    wrong_kind(key, raw, ", without quotes unless it holds pi");
  if (text->find_first_not_of(" \t") == std::string::npos) wrong_kind(key, raw);
  return parse_number(source_text(*text, raw));
}

void check_range(const Key& key, double value, const SourceLocation& location, const std::string& hint = "") {
  if (contains(key.range, value)) return;
  const char* const fault = std::isfinite(value) ? " is out of range" : " is not finite";
  fail(location, std::string(key.name) + " = " + number_text(value) + fault + expected(key) + hint);
}

std::int64_t integer_of(const Key& key, const ParsedValue& raw) {
  const double value = number_of(key, raw);
  if (std::isfinite(value) && value != std::floor(value)) {
    fail(raw.location, std::string(key.name) + " = " + number_text(value) + " is a fraction" + expected(key));
  }
  check_range(key, value, raw.location);
  return static_cast<std::int64_t>(value);
}

double in_range(const Key& key, double value, const SourceLocation& location) {
  check_range(key, value, location);
  return value;
}

bool flag_of(const Key& key, const ParsedValue& raw) {
  if (const auto* const flag = std::get_if<bool>(&raw.data)) return *flag;
  const auto* const text = std::get_if<std::string>(&raw.data);
  if (text == nullptr || !raw.untyped || (*text != "true" && *text != "false")) wrong_kind(key, raw);
  return *text == "true";
}

std::string text_of(const Key& key, const ParsedValue& raw) {
  const auto* const text = std::get_if<std::string>(&raw.data);
  if (text == nullptr) wrong_kind(key, raw, ", in quotes");
  if (text->find('\0') != std::string::npos)
    fail(raw.location, std::string(key.name) + " holds a NUL character, at which a file would end it; leave it out");
  return *text;
}

std::string choice_of(const Key& key, const ParsedValue& raw) {
  std::string text = text_of(key, raw);
  for (const std::string_view choice : key.choices) {
    if (choice == text) return text;
  }
  const std::string_view near = nearest(text, key.choices);
  wrong_kind(key, raw, near.empty() ? "" : "; did you mean '" + std::string(near) + "'?");
}

AxisValues list_of(const Key& key, const ParsedList& list) {
  AxisValues axis;
  for (const ParsedValue& element : list) {
    axis.values.push_back(number_of(key, element));
    axis.locations.push_back(element.location);
  }
  axis.text = toml_list(axis.values);
  return axis;
}

AxisValues unchecked_axis(const Key& key, const ParsedValue& raw) {
  if (const auto* const list = std::get_if<ParsedList>(&raw.data)) return list_of(key, *list);
  if (const auto* const text = std::get_if<std::string>(&raw.data)) return parse_axis(source_text(*text, raw));
  return list_of(key, {raw});
}

}  // namespace

Value convert(const Key& key, const ParsedValue& raw) {
  if (key.kind == Kind::number || key.kind == Kind::integer) check_single(key, raw);
  switch (key.kind) {
    case Kind::number:
      return in_range(key, number_of(key, raw), raw.location);
    case Kind::integer:
      return integer_of(key, raw);
    case Kind::flag:
      return flag_of(key, raw);
    case Kind::choice:
      return choice_of(key, raw);
    case Kind::text:
    case Kind::names:
      break;
  }
  return text_of(key, raw);
}

AxisValues convert_axis(const Key& key, const ParsedValue& raw) {
  AxisValues axis = unchecked_axis(key, raw);
  if (axis.values.empty()) fail(raw.location, "an empty axis; give " + std::string(key.name) + " at least one value");
  if (static_cast<double>(axis.values.size()) > max_axis_values) {
    fail(raw.location,
         std::to_string(axis.values.size()) + " values; expected at most " + number_text(max_axis_values));
  }
  const auto* const text = std::get_if<std::string>(&raw.data);
  const std::string hint = text == nullptr ? "" : comma_hint(*text);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    check_range(key, axis.values[i], i < axis.locations.size() ? axis.locations[i] : raw.location, hint);
  }
  return axis;
}

}  // namespace clatter::config
