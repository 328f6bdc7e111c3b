#include "config/comma.hpp"

#include <algorithm>
#include <cctype>

#include "config/text_file.hpp"

namespace clatter::config {
namespace {

bool is_digit(char character) { return std::isdigit(static_cast<unsigned char>(character)) != 0; }

/// Whether a comma stands between digits, as it may in a list or in a number.
bool joins_digits(std::string_view text, std::size_t comma) {
  return comma > 0 && comma + 1 < text.size() && is_digit(text[comma - 1]) && is_digit(text[comma + 1]);
}

/// Whether exactly three digits follow each comma.
bool has_thousands(std::string_view text) {
  for (std::size_t comma = text.find(','); comma != std::string_view::npos; comma = text.find(',', comma + 1)) {
    const std::size_t end = std::min(text.find(',', comma + 1), text.size());
    if (end - comma != 4 || !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(comma) + 1,
                                         text.begin() + static_cast<std::ptrdiff_t>(end), is_digit))
      return false;
  }
  return true;
}

}  // namespace

std::string comma_hint(std::string_view text, Kind kind) {
  std::string number(without_blanks(text));
  const std::size_t comma = number.find(',');
  if (comma == std::string::npos || number.find_first_of(".[( \t") != std::string::npos) return {};
  if (kind == Kind::integer && has_thousands(number)) {
    std::erase(number, ',');
    return "; write it without commas: " + number;
  }
  if (!joins_digits(number, comma) || number.find(',', comma + 1) != std::string::npos) return {};
  number[comma] = '.';
  return "; a decimal comma? write " + number;
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
