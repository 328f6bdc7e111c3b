#include "tables/variable_words.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

#include "branches/branch.hpp"
#include "config/suggestion.hpp"
#include "storage/utf8.hpp"
#include "tables/csv_text.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {

bool is_text(const results::Variable& variable) {
  return std::holds_alternative<std::vector<std::string>>(variable.values);
}

std::vector<std::string> words_of(const results::Variable& variable) {
  if (const auto* const texts = std::get_if<std::vector<std::string>>(&variable.values)) return *texts;
  const std::vector<std::string> meanings = meanings_of(variable);
  const std::vector<double> flags = numbers_in(variable.values);
  std::vector<std::string> words(flags.size());
  for (std::size_t i = 0; i < flags.size(); ++i) append_value(words[i], variable.values, i, meanings);
  return words;
}

namespace {

std::vector<std::string> known_words(const results::Variable& variable) {
  if (variable.name != "special_kind") return meanings_of(variable);
  std::vector<std::string> names;
  for (int kind = 0; kind <= static_cast<int>(branches::SpecialKind::motion_ceases); ++kind)
    names.emplace_back(name_of(static_cast<branches::SpecialKind>(kind)));
  for (std::string& word : words_of(variable))  // a file of another version may have others
    if (std::ranges::find(names, word) == names.end()) names.push_back(std::move(word));
  return names;
}

}  // namespace

void require_known_word(const Condition& condition, const results::Variable& variable) {
  std::vector<std::string_view> known;
  const std::vector<std::string> words = known_words(variable);
  for (const std::string& word : words)
    if (!word.empty()) known.push_back(word);
  if (known.empty() || std::ranges::find(known, condition.word) != known.end()) return;
  throw ChoiceError("--where " + text_of(condition) + ": no such " + condition.name +
                    config::suggestion(condition.word, known, "; there are "));
}

std::string words_there(const std::string& meant, const std::vector<std::string>& words) {
  constexpr std::size_t most = 8;
  std::map<std::string, std::size_t> number;
  for (const std::string& word : words)
    if (!word.empty()) ++number[word];
  std::vector<std::string> there;
  for (const auto& [word, count] : number) there.push_back(word);
  std::ranges::stable_sort(there, std::greater{}, [&](const std::string& word) { return number[word]; });
  if (there.empty()) return " has no value at any point";
  const std::vector<std::string_view> all(there.begin(), there.end());
  std::string text = there.size() == 1 ? " is " : " is one of ";
  for (std::size_t i = 0; i < std::min(most, there.size()); ++i)
    text += (i == 0 ? "" : ", ") + storage::excerpt(there[i], 40);
  if (there.size() > most) text += ", ...";
  const std::string_view near = config::nearest(meant, all);
  return text + (near.empty() || near == meant ? "" : "; did you mean " + config::in_quotes(near) + '?');
}

}  // namespace clatter::app
