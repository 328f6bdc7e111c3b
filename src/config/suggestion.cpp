#include "config/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "config/text_file.hpp"
#include "config/unit.hpp"
#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

constexpr std::size_t max_quoted = 60;  // bytes

/// The least number of insertions, deletions, replacements and swaps of neighbours between two words (Damerau 1964).
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before_last, last(to.size() + 1), row(to.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (from[i - 1] != to[j - 1])});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::exchange(last, row);
  }
  return last.back();
}

/// The shortest name that begins with the written word, if that has at least three letters; empty if there is none.
std::string_view completed(const std::string& written, std::span<const std::string_view> names) {
  std::string_view best;
  if (written.size() < 3) return best;
  for (const std::string_view name : names) {
    if (lower_case(name).starts_with(written) && (best.empty() || name.size() < best.size())) best = name;
  }
  return best;
}

bool is_digit(char character) { return std::isdigit(static_cast<unsigned char>(character)) != 0; }

/// Whether a comma stands between digits, as it may in a list or in a number.
bool joins_digits(std::string_view text, std::size_t comma) {
  return comma > 0 && comma + 1 < text.size() && is_digit(text[comma - 1]) && is_digit(text[comma + 1]);
}

/// Whether exactly three digits follow each comma, and one to three, no leading 0, come before the first.
bool has_thousands(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of("+-"), text.size()), before = text.find(',') - first;
  if (before < 1 || before > 3 || text[first] == '0' || !is_digit(text[first])) return false;
  for (std::size_t comma = text.find(','); comma != std::string_view::npos; comma = text.find(',', comma + 1)) {
    const std::size_t end = std::min(text.find(',', comma + 1), text.size());
    if (end - comma != 4 || !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(comma) + 1,
                                         text.begin() + static_cast<std::ptrdiff_t>(end), is_digit))
      return false;
  }
  return true;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::string in_quotes(std::string_view text) { return '\'' + storage::excerpt(text, max_quoted) + '\''; }

std::string_view nearest(std::string_view written, std::span<const std::string_view> names) {
  if (written.size() > max_quoted) return {};
  const std::string lower = lower_case(written);
  std::string_view best = completed(lower, names);
  if (!best.empty()) return best;
  std::size_t best_distance = written.size() / 3 + 1;  // one slip in a short word, more in a longer one
  for (const std::string_view name : names) {
    const std::size_t distance = edit_distance(lower, lower_case(name));
    if (distance > best_distance || distance >= name.size() || (!best.empty() && distance == best_distance)) continue;
    best = name;
    best_distance = distance;
  }
  return best;
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) (text += text.empty() ? "" : ", ") += name;
  return text;
}

std::string suggestion(std::string_view written, std::span<const std::string_view> names, std::string_view otherwise) {
  const std::string_view name = nearest(written, names);
  if (name.empty()) return std::string(otherwise) + joined(names);
  return "; did you mean '" + std::string(name) + "'?";
}

std::string comma_hint(std::string_view text, Kind kind) {
  const std::string_view whole = without_blanks(text), unit = whole.substr(std::min(whole.find(' '), whole.size()));
  std::string number(whole.substr(0, whole.size() - unit.size()));
  const std::size_t comma = number.find(',');
  if (comma == std::string::npos || number.find_first_of(".[(\t") != std::string::npos) return {};
  if (!unit.empty() && !parse_unit(without_blanks(unit))) return {};
  std::string without = number;
  std::erase(without, ',');
  if (kind == Kind::integer && has_thousands(number)) return "; write it without commas: " + without;
  const std::string thousands = has_thousands(number) ? "; thousands? write " + without.append(unit) : "";
  if (!joins_digits(number, comma) || number.find(',', comma + 1) != std::string::npos) return thousands;
  number[comma] = '.';
  return "; a decimal comma? write " + number.append(unit) + thousands;
}

std::string comma_hint_within(std::string_view text) {
  for (std::size_t comma = text.find(','); comma != std::string_view::npos; comma = text.find(',', comma + 1)) {
    if (!joins_digits(text, comma)) continue;
    std::size_t begin = comma, end = comma + 1;
    while (begin > 0 && is_digit(text[begin - 1])) --begin;
    while (end < text.size() && is_digit(text[end])) ++end;
    return comma_hint(text.substr(begin, end - begin));
  }
  return {};
}

}  // namespace clatter::config
