#include "config/value_grammar.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "config/axis_functions.hpp"
#include "config/look_alike.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "config/unit.hpp"
#include "config/unit_hint.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

constexpr std::string_view blanks_and_ends = " \t\r\n";

/// Reads a value from its first character to its last by recursive descent.
class Parser {
 public:
  explicit Parser(const SourceText& source) : source_(source) {
    check_look_alikes();
    skip_blanks();
  }

  [[nodiscard]] Measure whole_number() {
    const Measure measured = measure();
    expect_end();
    return measured;
  }

  [[nodiscard]] LeadingNumber leading_number() {
    const double value = product();
    return {value, rest().substr(0, rest().find_last_not_of(blanks_and_ends) + 1)};
  }

  [[nodiscard]] AxisValues axis() {
    if (at_end()) fail_here("an empty axis; give at least one value");
    const std::size_t begin = at_;
    const std::string_view name = word();
    AxisValues axis = peek('(') ? call(name, begin) : (at_ = begin, list());
    expect_end();
    return axis;
  }

 private:
  [[nodiscard]] bool at_end() const { return at_ == source_.text.size(); }
  [[nodiscard]] bool peek(char character) const { return !at_end() && source_.text[at_] == character; }
  [[nodiscard]] std::string_view rest() const { return source_.text.substr(at_); }

  /// Refuses what looks like a minus, a quote or a blank, none of which a number or a unit has.
  void check_look_alikes() const {
    if (const auto found = find_look_alike(source_.text)) fail_at(found->at, found->hint);
  }

  void skip_blanks() { at_ = std::min(source_.text.find_first_not_of(blanks_and_ends, at_), source_.text.size()); }

  bool accept(char character) {
    if (!peek(character)) return false;
    ++at_;
    skip_blanks();
    return true;
  }

  [[nodiscard]] SourceLocation location_at(std::size_t offset) const {
    SourceLocation location = source_.location;
    if (source_.columns) location.column += storage::characters(source_.text.substr(0, offset));
    return location;
  }

  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const {
    fail(location_at(offset), message);
  }

  [[noreturn]] void fail_here(const std::string& message) const { fail_at(at_, message); }

  /// Describes the text at this point, for a message.
  [[nodiscard]] std::string found() const {
    return at_end() ? "found the end of the value" : "found " + in_quotes(rest());
  }

  void expect_end() const {
    if (!at_end()) fail_here("expected the end of the value, " + found());
  }

  std::string_view word() {
    const std::size_t begin = at_;
    while (!at_end() && std::isalpha(static_cast<unsigned char>(source_.text[at_])) != 0) ++at_;
    const std::string_view name = source_.text.substr(begin, at_ - begin);
    skip_blanks();
    return name;
  }

  /// A number, and its unit.
  [[nodiscard]] Measure measure() {
    const double value = product();
    const std::size_t begin = at_;
    const std::string_view text = unit_text();
    if (!begins_unit(text) || text.starts_with("pi")) return {value, false};
    const std::optional<Unit> unit = parse_unit(text.starts_with('/') ? '1' + std::string(text) : text);
    if (!unit) return refuse_unit(text, value);
    if (!fits(*unit, source_.quantity))
      fail_at(begin, "the unit " + in_quotes(text) + " doesn't fit; expected " + description_of(source_.quantity) +
                         std::string(source_.way_out));
    at_ += text.size();
    return {in_si(value, *unit, source_.quantity), true};
  }

  /// Refuses an unknown unit with a way out; without one, what follows a number without unit is none.
  Measure refuse_unit(std::string_view text, double value) {
    const std::string hint = unit_hint(without_blanks(text), source_.quantity), unknown = "unknown unit ";
    if (hint.ends_with('?')) fail_here(unknown + in_quotes(text) + hint);
    if (source_.quantity == Quantity::number) return {value, false};
    fail_here(unknown + in_quotes(text) + "; expected " + description_of(source_.quantity) +
              ", by products and quotients of " + unit_names() + " with prefixes: mm, N s/m" + hint);
  }

  /// The text at this point up to the next ',', ')' or ']' outside brackets of its own.
  [[nodiscard]] std::string_view unit_text() const {
    const std::string_view text = rest();
    std::size_t end = 0;
    for (int depth = 0; end < text.size() && text[end] != ',' && text[end] != ']'; ++end) {
      depth += (text[end] == '(') - (text[end] == ')');
      if (depth < 0) break;
    }
    return text.substr(0, end);
  }

  /// Whether a text is that of a unit: a word, %, or one over a unit.
  [[nodiscard]] static bool begins_unit(std::string_view text) {
    constexpr unsigned char ascii = 0x80;
    const unsigned char first = text.empty() ? ' ' : static_cast<unsigned char>(text.front());
    const bool is_inverse = first == '/' || (first == '1' && without_blanks(text.substr(1)).starts_with('/'));
    return std::isalpha(first) != 0 || first >= ascii || first == '%' || is_inverse;
  }

  /// Whether a '/' at this point divides by a unit, as in 1500/min.
  [[nodiscard]] bool divides_by_unit() const {
    return peek('/') && parse_unit('1' + std::string(unit_text())).has_value();
  }

  [[nodiscard]] double product() {
    double value = factor();
    while ((peek('*') || peek('/')) && !divides_by_unit()) {
      const bool times = peek('*');
      ++at_;
      skip_blanks();
      const double right = factor();
      value = times ? value * right : value / right;
    }
    return value;
  }

  [[nodiscard]] double factor() {
    const std::size_t begin = at_;
    const bool negative = peek('-');
    if (!accept('-')) accept('+');
    const double value = unsigned_number(begin);
    return negative ? -value : value;
  }

  [[nodiscard]] double unsigned_number(std::size_t begin) {
    double value = std::numbers::pi;
    if (rest().starts_with("pi")) {
      at_ += 2;
    } else {
      if (peek('-') || peek('+')) fail_at(begin, "expected a number, found two signs");
      const char* const first = source_.text.data() + at_;
      const auto [end, error] = std::from_chars(first, source_.text.data() + source_.text.size(), value);
      if (error == std::errc::result_out_of_range)
        fail_at(begin, in_quotes(rest()) + " is beyond the range of double precision");
      if (error != std::errc{}) fail_at(begin, "expected a number, such as 0.5 or 2*pi, " + found());
      at_ += static_cast<std::size_t>(end - first);
    }
    skip_blanks();
    return value;
  }

  [[nodiscard]] AxisValues list() {
    const bool bracket = accept('[');
    AxisValues axis;
    std::vector<Measure> measures;
    if (bracket && accept(']')) fail_at(0, "an empty axis; give at least one value");
    do {
      axis.locations.push_back(location_at(at_));
      measures.push_back(measure());
      axis.values.push_back(measures.back().value);
    } while (accept(','));
    if (bracket && !accept(']')) fail_here("expected ',' or ']', " + found());
    check_units(measures, axis.locations);
    axis.text = toml_list(axis.values, source_.unit);
    return axis;
  }

  /// The three numbers in brackets; the last one is a count, without unit, or a step.
  [[nodiscard]] std::array<double, 3> arguments_of(const AxisFunction& function) {
    std::array<double, 3> arguments{};
    std::vector<Measure> measures;
    std::vector<SourceLocation> locations;
    accept('(');
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (i > 0 && !accept(',')) fail_here("expected ',' in " + std::string(function.usage) + ", " + found());
      if (i == 2 && function.counts) {
        arguments[i] = product();
        continue;
      }
      locations.push_back(location_at(at_));
      measures.push_back(measure());
      arguments[i] = measures.back().value;
    }
    if (!accept(')'))
      fail_here("expected ')' after the three arguments of " + std::string(function.usage) + ", " + found() +
                comma_hint_within(source_.text));
    check_units(measures, locations);
    return arguments;
  }

  [[nodiscard]] AxisValues call(std::string_view name, std::size_t begin) {
    const std::optional<AxisFunction> function = axis_function(name);
    if (!function) {
      fail_at(begin,
              "unknown function " + in_quotes(name) + suggestion(name, axis_function_names(), "; expected one of "));
    }
    const std::array<double, 3> arguments = arguments_of(*function);
    AxisValues axis;
    if (const std::string mistake = function->evaluate(arguments, axis.values); !mistake.empty())
      fail_at(begin, mistake);
    if (name == sobol_name) axis.sobol = {arguments[0], arguments[1]};
    const std::string unit = source_.unit.empty() ? "" : ' ' + std::string(source_.unit);
    axis.text = '"' + std::string(name) + '(' + number_text(arguments[0]) + unit + ", " + number_text(arguments[1]) +
                unit + ", " + number_text(arguments[2]) + (function->counts ? "" : unit) + ")\"";
    return axis;
  }

  const SourceText& source_;
  std::size_t at_ = 0;
};

}  // namespace

double parse_number(const SourceText& source) { return parse_measure(source).value; }

Measure parse_measure(const SourceText& source) { return Parser(source).whole_number(); }

LeadingNumber parse_leading_number(const SourceText& source) { return Parser(source).leading_number(); }

void check_units(const std::vector<Measure>& measures, const std::vector<SourceLocation>& locations) {
  if (std::ranges::none_of(measures, &Measure::has_unit)) return;
  const auto lacks_unit = [](const Measure& measure) {
    return !measure.has_unit && measure.value != 0 && !std::isinf(measure.value);
  };
  const auto bare = std::ranges::find_if(measures, lacks_unit);
  if (bare == measures.end()) return;
  fail(locations[static_cast<std::size_t>(bare - measures.begin())],
       number_text(bare->value) + " without a unit beside a number with one; give each its unit, or none");
}

AxisValues parse_axis(const SourceText& source) { return Parser(source).axis(); }

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string toml_number(double value) {
  std::string text = number_text(value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::string toml_measure(double value, std::string_view unit) {
  return '"' + number_text(value) + ' ' + std::string(unit) + '"';
}

std::string toml_list(const std::vector<double>& values, std::string_view unit) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "[" : ", ") + (unit.empty() ? toml_number(value) : toml_measure(value, unit));
  return text + ']';
}

bool has_unit(std::string_view text) {
  constexpr std::array<std::string_view, 3> numbers{"pi", "inf", "nan"};
  constexpr std::string_view digits = "0123456789.";
  const auto functions = axis_function_names();
  const auto is_in_word = [](unsigned char character) { return std::isalpha(character) != 0 || character >= 0x80; };
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    while (end < text.size() && is_in_word(static_cast<unsigned char>(text[end]))) ++end;
    const std::string_view word = text.substr(begin, end - begin);
    const bool after_digit = begin > 0 && digits.find(text[begin - 1]) != std::string_view::npos;
    const bool is_exponent = after_digit && (word == "e" || word == "E");
    const bool is_known =
        std::ranges::find(numbers, word) != numbers.end() || std::ranges::find(functions, word) != functions.end();
    if (!word.empty() && !is_exponent && !is_known) return true;
    begin = std::max(end, begin + 1);
  }
  return false;
}

}  // namespace clatter::config
