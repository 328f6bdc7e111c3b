#include "tables/condition.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "config/config_error.hpp"
#include "config/look_alike.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "storage/utf8.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {
namespace {

constexpr std::array<std::pair<std::string_view, Comparison>, 7> signs{{{"<=", Comparison::at_most},
                                                                        {">=", Comparison::at_least},
                                                                        {"!=", Comparison::not_equal},
                                                                        {"==", Comparison::equal},
                                                                        {"=", Comparison::equal},
                                                                        {"<", Comparison::less},
                                                                        {">", Comparison::greater}}};

/// Signs of other languages, and ours.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> other_signs{
    {{"=<", "<="}, {"=>", ">="}, {"<>", "!="}, {"=!", "!="}}};

constexpr std::string_view comparing = "=<>!", conditions = "expected e.g. nu=1.0, 'impact_speed < 0.4 m/s' or word=LU";

std::string_view sign_of(Comparison comparison) {
  if (comparison == Comparison::equal) return "=";
  return std::ranges::find(signs, comparison, &std::pair<std::string_view, Comparison>::second)->first;
}

/// A comparison with its sides exchanged.
Comparison turned(Comparison comparison) {
  switch (comparison) {
    case Comparison::less:
      return Comparison::greater;
    case Comparison::at_most:
      return Comparison::at_least;
    case Comparison::greater:
      return Comparison::less;
    case Comparison::at_least:
      return Comparison::at_most;
    default:
      return comparison;
  }
}

bool begins_number(std::string_view text) {
  return !text.empty() && std::string_view("0123456789.+-").find(text.front()) != std::string_view::npos;
}

/// "--where 'nu < 2'"
std::string option_with(std::string_view condition) {
  return "--where " + storage::quoted_name(config::without_blanks(condition));
}

/// What other languages join conditions by.
struct Joint {
  std::size_t at;
  std::string_view text;
  bool is_either;
};

constexpr std::array joints{Joint{0, "&&", false}, Joint{0, "||", true},   Joint{0, "&", false}, Joint{0, "|", true},
                            Joint{0, ";", false},  Joint{0, "and", false}, Joint{0, "or", true}, Joint{0, ",", false}};

/// Whether a word stands by itself at a place of a text, in capitals or not; signs always do.
bool stands_at(std::string_view word, std::string_view text, std::size_t at) {
  const auto is_same = [](unsigned char one, unsigned char other) { return std::tolower(one) == std::tolower(other); };
  if (!std::ranges::equal(word, text.substr(at, word.size()), is_same)) return false;
  if (std::isalpha(static_cast<unsigned char>(word.front())) == 0) return true;
  const auto is_blank = [&](std::size_t place) { return place < text.size() && text[place] == ' '; };
  return at > 0 && is_blank(at - 1) && is_blank(at + word.size());
}

/// The first of the joints that a value has, a comma last: numbers may have one.
std::optional<Joint> joint_in(std::string_view value) {
  for (const Joint& joint : joints)
    for (std::size_t at = 0; at < value.size(); ++at)
      if (stands_at(joint.text, value, at)) return Joint{at, value.substr(at, joint.text.size()), joint.is_either};
  return std::nullopt;
}

/// Refuses two conditions, or two values, in one argument; `begin` is all before the value.
void require_one(const std::string& option, std::string_view begin, std::string_view value) {
  const auto joint = joint_in(value);
  if (!joint) return;
  if (joint->text == ",")
    for (const std::string& hint : {config::comma_hint(value), config::comma_hint_within(value)})
      if (!hint.empty()) throw ChoiceError(option + hint);
  const std::string first = std::string(begin) + std::string(value.substr(0, joint->at)),
                    said = option + ": " + config::in_quotes(joint->text) + " joins nothing here; ";
  const std::string_view second = config::without_blanks(value.substr(joint->at + joint->text.size()));
  if (second.find_first_of(comparing) == std::string_view::npos)
    throw ChoiceError(said + "a condition compares with one value, as in " + option_with(first) +
                      "; a range is two conditions, e.g. --where 'nu >= 1' --where 'nu <= 2'");
  const bool either = joint->is_either;
  throw ChoiceError(said + (either ? "all conditions hold at once, so ask twice: " : "write ") + option_with(first) +
                    (either ? ", then " : " ") + option_with(second));
}

/// Refuses more than one comparison, as in 0.2 < x < 0.4, and signs of other languages.
void require_one_sign(const std::string& option, std::string_view text, std::size_t at, const Condition& condition) {
  for (const auto& [other, ours] : other_signs)
    if (text.substr(at).starts_with(other))
      throw ChoiceError(option + ": the sign is " + std::string(ours) + "; write " +
                        option_with(std::string(text.substr(0, at)) + std::string(ours) +
                                    std::string(text.substr(at + other.size()))));
  const std::size_t second = condition.word.find_first_of(comparing);
  const std::string middle(config::without_blanks(std::string_view(condition.word).substr(0, second)));
  if (second == std::string::npos && !(begins_number(condition.name) && !begins_number(condition.word))) return;
  const std::string sign(sign_of(turned(condition.comparison)));
  const std::string first = option_with(middle + ' ' + sign + ' ' + condition.name);
  if (second == std::string::npos) throw ChoiceError(option + ": the name comes first; write " + first);
  if (begins_number(condition.name))
    throw ChoiceError(option + ": a condition has one comparison; write " + first + ' ' + option_with(condition.word));
  throw ChoiceError(option + ": a condition has one comparison; " + std::string(conditions));
}

}  // namespace

std::string text_of(const Condition& condition) {
  return condition.name + std::string(sign_of(condition.comparison)) + condition.word;
}

bool holds(double number, Comparison comparison, double asked, double same) {
  const bool is_same = number == asked || std::abs(number - asked) <= same;
  switch (comparison) {
    case Comparison::equal:
      return is_same;
    case Comparison::not_equal:
      return !is_same && !std::isnan(number);
    case Comparison::less:
      return number < asked && !is_same;
    case Comparison::at_most:
      return number < asked || is_same;
    case Comparison::greater:
      return number > asked && !is_same;
    case Comparison::at_least:
      return number > asked || is_same;
  }
  return false;
}

bool exclude(Comparison one, double asked, Comparison other, double asked_by_other) {
  // Numbers that meet one are a ray, a point or all but a point, so they meet the other at an end of theirs or nowhere.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double end : {asked, asked_by_other})
    for (const double number : {std::nextafter(end, -infinity), end, std::nextafter(end, infinity)})
      if (holds(number, one, asked, 0) && holds(number, other, asked_by_other, 0)) return false;
  return true;
}

Condition condition_of(const std::string& text) {
  const std::string option = "--where " + config::in_quotes(text);
  if (const auto found = config::find_look_alike(text)) throw ChoiceError(option + ": " + found->hint);
  const std::size_t at = text.find_first_of(comparing);
  const auto sign = std::ranges::find_if(
      signs, [&](const auto& one) { return at != std::string::npos && text.substr(at).starts_with(one.first); });
  const std::string name(config::without_blanks(std::string_view(text).substr(0, std::min(at, text.size()))));
  if (sign == signs.end() || name.empty()) throw ChoiceError(option + "; " + std::string(conditions));
  const std::size_t end = at + sign->first.size();
  Condition condition{
      name, sign->second, {}, config::unquoted(config::without_blanks(std::string_view(text).substr(end)))};
  if (condition.word.empty()) throw ChoiceError(option + ": nothing to compare with; " + std::string(conditions));
  require_one(option, std::string_view(text).substr(0, end), std::string_view(text).substr(end));
  require_one_sign(option, text, at, condition);
  const bool is_word = condition.word.find_first_of("0123456789") == std::string::npos &&
                       condition.word.find("pi") == std::string::npos && condition.word != "inf" &&
                       condition.word != "-inf";
  if (is_word) return condition;
  try {
    condition.value = config::parse_reading({condition.word, {.source = option}});
  } catch (const config::ConfigError& error) {
    if (begins_number(condition.word)) throw ChoiceError(std::string(error.what()) + "; " + std::string(conditions));
  }
  return condition;
}

}  // namespace clatter::app
