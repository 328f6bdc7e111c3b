#include <algorithm>
#include <cmath>
#include <type_traits>

#include "config/axis_functions.hpp"
#include "config/consistency.hpp"
#include "config/settings.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "config/unit.hpp"

namespace clatter::config {
namespace {

/// Describes a written value, for a message.
std::string found(const ParsedValue& written) {
  const auto describe = [](const auto& data) -> std::string {
    using Data = std::decay_t<decltype(data)>;
    if constexpr (std::is_same_v<Data, std::string>) return data.empty() ? "nothing" : "the text " + in_quotes(data);
    if constexpr (std::is_same_v<Data, bool>) return data ? "true" : "false";
    if constexpr (std::is_same_v<Data, std::int64_t>) return "the number " + std::to_string(data);
    if constexpr (std::is_same_v<Data, double>) return "the number " + number_text(data);
    if constexpr (std::is_same_v<Data, ParsedList>) return "a list";
    if constexpr (std::is_same_v<Data, Unsupported>) return data.name;
  };
  return std::visit(describe, written.data);
}

/// "; expected 0 ... 1", "; expected one of fft, exact"
std::string expected(const Key& key) {
  return (key.kind == Kind::choice ? "; expected one of " : "; expected ") + permitted(key);
}

[[noreturn]] void wrong_kind(const Key& key, const ParsedValue& written, const std::string& way_out = "") {
  fail(written.location, std::string(key.name) + " = " + found(written) + expected(key) + way_out);
}

/// Whether a text stands for several values.
bool is_axis(std::string_view text) {
  const auto names = axis_function_names();
  const bool calls = std::ranges::any_of(names, [&](std::string_view name) { return text.starts_with(name); });
  return calls || text.starts_with('[') || text.find(',') != std::string_view::npos;
}

/// Says where several values belong: those of a key that describes the scene are an axis.
std::string home_of_axis(const Key& key, const ParsedValue& written) {
  if (!describes_scene(key.section)) return "; one value, since only keys of [scene] or [machine] can be axes";
  const auto* const text = std::get_if<std::string>(&written.data);
  if (!on_command_line(written.location) || text == nullptr)
    return "; several values are an axis, and its line belongs in [sweep]";
  return "; several values are an axis: --set sweep." + std::string(key.name) + "='" + *text + '\'';
}

/// Refuses several values, or a number with a comma, where one value is needed; the message says what to write.
void check_single(const Key& key, const ParsedValue& written) {
  const auto* const text = std::get_if<std::string>(&written.data);
  if (std::holds_alternative<ParsedList>(written.data)) wrong_kind(key, written, home_of_axis(key, written));
  if (text != nullptr && is_axis(*text))
    wrong_kind(key, written, comma_hint(*text, key.kind) + home_of_axis(key, written));
}

SourceText source_text(const Key& key, const std::string& text, const ParsedValue& written, bool is_si) {
  SourceText source{text, written.location, written.untyped || written.inset > 0};
  source.location.column += written.inset;
  const bool takes_unit = is_si || key.section == "machine" || key.quantity == Quantity::angle;
  if (takes_unit) source.quantity = quantity_of(key, written);
  if (source.quantity != key.quantity) source.unit = unit_of_numbers(source.quantity);
  if (key.section == "scene" || (!takes_unit && key.quantity != Quantity::number))
    source.way_out = ", or the scene in [machine], which has units";
  else if (key.name == "damping_ratio" || key.name == "quality")
    source.way_out = ", or 'damping' in N s/m";
  else if (key.with_unit != Quantity::number)
    source.way_out = ", or a damping ratio without unit";
  return source;
}

/// The number that was written; in TOML a text is one only if it holds pi or a unit, since "0.5" in quotes is a slip.
Measure measure_of(const Key& key, const ParsedValue& written, bool is_si) {
  if (const auto* const integer = std::get_if<std::int64_t>(&written.data)) return {static_cast<double>(*integer)};
  if (const auto* const number = std::get_if<double>(&written.data)) return {*number};
  const auto* const text = std::get_if<std::string>(&written.data);
  if (text == nullptr) wrong_kind(key, written);
  const bool is_expression = written.untyped || text->find("pi") != std::string::npos;
  constexpr const char* way_out = ", without quotes unless it holds pi or a unit";
  if (!is_expression && text->find_first_of("0123456789") == std::string::npos) wrong_kind(key, written, way_out);
  if (text->find_first_not_of(" \t") == std::string::npos) wrong_kind(key, written);
  const Measure measure = parse_measure(source_text(key, *text, written, is_si));
  if (!is_expression && !measure.has_unit) wrong_kind(key, written, way_out);
  return measure;
}

double number_of(const Key& key, const ParsedValue& written, bool is_si = false) {
  return measure_of(key, written, is_si).value;
}

void check_range(const Key& key, double value, const SourceLocation& location, const std::string& hint = "") {
  if (contains(key.range, value)) return;
  const char* const fault = std::isfinite(value) ? " is out of range" : " is not finite";
  fail(location, std::string(key.name) + " = " + number_text(value) + fault + expected(key) + hint);
}

std::int64_t integer_of(const Key& key, const ParsedValue& written) {
  const auto [value, has_unit] = measure_of(key, written, false);
  if (has_unit) wrong_kind(key, written);
  if (std::isfinite(value) && value != std::floor(value)) {
    fail(written.location, std::string(key.name) + " = " + number_text(value) + " is a fraction" + expected(key));
  }
  check_range(key, value, written.location);
  return static_cast<std::int64_t>(value);
}

double in_range(const Key& key, double value, const SourceLocation& location) {
  check_range(key, value, location);
  return value;
}

bool flag_of(const Key& key, const ParsedValue& written) {
  if (const auto* const flag = std::get_if<bool>(&written.data)) return *flag;
  const auto* const text = std::get_if<std::string>(&written.data);
  if (text == nullptr || !written.untyped || (*text != "true" && *text != "false")) wrong_kind(key, written);
  return *text == "true";
}

std::string text_of(const Key& key, const ParsedValue& written) {
  const auto* const text = std::get_if<std::string>(&written.data);
  if (text == nullptr) wrong_kind(key, written, ", in quotes");
  if (text->find('\0') != std::string::npos)
    fail(written.location,
         std::string(key.name) + " holds a NUL character, at which a file would end it; leave it out");
  return *text;
}

std::string choice_of(const Key& key, const ParsedValue& written) {
  std::string text = text_of(key, written);
  for (const std::string_view choice : key.choices) {
    if (choice == text) return text;
  }
  const std::string_view near = nearest(text, key.choices);
  wrong_kind(key, written, near.empty() ? "" : "; did you mean '" + std::string(near) + "'?");
}

/// The words of a list, or between the commas of a text, which may have the brackets and quotes of a list.
std::vector<ParsedValue> words_of(const Key& key, const ParsedValue& written) {
  if (const auto* const list = std::get_if<ParsedList>(&written.data)) return *list;
  const std::string text = text_of(key, written);
  std::string_view inside = without_blanks(text);
  if (written.untyped && inside.starts_with('[') && inside.ends_with(']')) {
    inside = without_blanks(inside.substr(1, inside.size() - 2));
    if (inside.empty()) return {};
  }
  std::vector<ParsedValue> words;
  for (const std::string& word : split_names(inside)) {
    words.push_back(written);
    words.back().data = written.untyped ? unquoted(word) : word;
  }
  return words;
}

/// Some of the choices in their order, each once, with commas between them, or "none".
std::string choices_of(const Key& key, const ParsedValue& written) {
  const std::vector<ParsedValue> words = words_of(key, written);
  std::vector<std::string> chosen;
  for (const ParsedValue& word : words) {
    const auto* const text = std::get_if<std::string>(&word.data);
    const bool is_none = words.size() == 1 && text != nullptr && *text == no_choice;
    if (!is_none) chosen.push_back(choice_of(key, word));
  }
  std::vector<std::string_view> in_order;
  for (const std::string_view choice : key.choices)
    if (std::ranges::find(chosen, choice) != chosen.end()) in_order.push_back(choice);
  return in_order.empty() ? std::string(no_choice) : joined(in_order);
}

/// Names with commas between them, from a text or a list.
std::string names_of(const Key& key, const ParsedValue& written) {
  const auto* const text = std::get_if<std::string>(&written.data);
  const bool is_list = text == nullptr || (written.untyped && without_blanks(*text).starts_with('['));
  if (!is_list) return text_of(key, written);
  std::string names;
  for (const ParsedValue& word : words_of(key, written)) (names += names.empty() ? "" : ", ") += text_of(key, word);
  return names;
}

AxisValues list_of(const Key& key, const ParsedList& list, bool is_si = false) {
  AxisValues axis;
  std::vector<Measure> measures;
  for (const ParsedValue& element : list) {
    measures.push_back(measure_of(key, element, is_si));
    axis.values.push_back(measures.back().value);
    axis.locations.push_back(element.location);
  }
  check_units(measures, axis.locations);
  const Quantity quantity = quantity_of(key, {list, {}, false, 0});
  axis.text = toml_list(axis.values, quantity == key.quantity ? "" : unit_of_numbers(quantity));
  return axis;
}

Interval interval_of(const Key& key, const ParsedValue& written, bool is_si) {
  const auto* const text = std::get_if<std::string>(&written.data);
  const bool several = std::holds_alternative<ParsedList>(written.data) || (text != nullptr && written.untyped);
  if (!several) wrong_kind(key, written);
  const std::vector<double> values = text != nullptr ? parse_axis(source_text(key, *text, written, is_si)).values
                                                     : list_of(key, std::get<ParsedList>(written.data), is_si).values;
  if (values.size() != 2 || !(values[0] < values[1]) || !std::isfinite(values[1] - values[0]))
    fail(written.location, std::string(key.name) + " = " + toml_list(values) + expected(key));
  return {values[0], values[1]};
}

AxisValues unchecked_axis(const Key& key, const ParsedValue& written) {
  const bool is_si = key.section == "machine";
  if (const auto* const list = std::get_if<ParsedList>(&written.data)) return list_of(key, *list, is_si);
  if (const auto* const text = std::get_if<std::string>(&written.data))
    return parse_axis(source_text(key, *text, written, is_si));
  return list_of(key, {written}, is_si);
}

}  // namespace

bool is_measure(const ParsedValue& written) {
  const auto* const text = std::get_if<std::string>(&written.data);
  if (const auto* const list = std::get_if<ParsedList>(&written.data)) return std::ranges::any_of(*list, is_measure);
  return text != nullptr && text->find_first_of("0123456789") != std::string::npos && has_unit(*text);
}

Quantity quantity_of(const Key& key, const ParsedValue& written) {
  if (key.with_unit == Quantity::number) return key.quantity;
  return is_measure(written) ? key.with_unit : key.quantity;
}

Value convert(const Key& key, const ParsedValue& written, bool is_si) {
  if (key.kind == Kind::number || key.kind == Kind::integer) check_single(key, written);
  switch (key.kind) {
    case Kind::number:
      return in_range(key, number_of(key, written, is_si), written.location);
    case Kind::interval:
      return interval_of(key, written, is_si);
    case Kind::integer:
      return integer_of(key, written);
    case Kind::flag:
      return flag_of(key, written);
    case Kind::choice:
      return choice_of(key, written);
    case Kind::choices:
      return choices_of(key, written);
    case Kind::names:
      return names_of(key, written);
    case Kind::text:
      break;
  }
  return text_of(key, written);
}

AxisValues convert_axis(const Key& key, const ParsedValue& written) {
  if (key.kind != Kind::number)
    fail(written.location, std::string(key.name) + " is a text, and an axis has numbers; give it in " +
                               (key.section == "machine" ? "[machine]" : "[scene]") + ", one run for each");
  AxisValues axis = unchecked_axis(key, written);
  if (axis.values.empty())
    fail(written.location, "an empty axis; give " + std::string(key.name) + " at least one value");
  if (static_cast<double>(axis.values.size()) > max_axis_values) {
    fail(written.location,
         std::to_string(axis.values.size()) + " values; expected at most " + number_text(max_axis_values));
  }
  const auto* const text = std::get_if<std::string>(&written.data);
  const std::string hint = text == nullptr ? "" : comma_hint(*text);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    check_range(key, axis.values[i], i < axis.locations.size() ? axis.locations[i] : written.location, hint);
  }
  return axis;
}

}  // namespace clatter::config
