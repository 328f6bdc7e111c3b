#include "tables/csv_text.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <type_traits>

namespace clatter::app {

void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Quotes a field if it needs that (RFC 4180, 2).
void append_text(std::string& text, std::string_view field) {
  if (field.find_first_of(",\"\n\r") == std::string_view::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char letter : field) text.append(letter == '"' ? 2 : 1, letter);
  text += '"';
}

std::size_t size_of(const results::Variable& variable) {
  return std::visit([](const auto& values) { return values.size(); }, variable.values);
}

void append_value(std::string& text, const results::ValueArray& values, std::size_t index,
                  const std::vector<std::string>& meanings) {
  std::visit(
      [&]<class T>(const std::vector<T>& of_type) {
        const T& value = of_type[index];
        if constexpr (std::is_same_v<T, std::string>) {
          append_text(text, value);
        } else if constexpr (std::is_same_v<T, double>) {
          append_number(text, value);
        } else {
          const auto flag = static_cast<std::size_t>(value);
          const bool has_meaning = flag < meanings.size() && !meanings[flag].empty();
          text += has_meaning ? meanings[flag] : std::to_string(value);
        }
      },
      values);
}

/// The meaning of each value of a flag; empty if the variable is none.
std::vector<std::string> meanings_of(const results::Variable& variable) {
  std::vector<std::string> meanings;
  const auto attribute = [&](std::string_view name) -> const auto* {
    const auto found = std::ranges::find(variable.attributes, name, &results::Attribute::first);
    return found == variable.attributes.end() ? nullptr : &found->second;
  };
  const auto *const values = attribute("flag_values"), *const words = attribute("flag_meanings");
  if (values == nullptr || words == nullptr) return meanings;
  std::istringstream stream(std::get<std::string>(*words));
  for (const std::uint8_t value : std::get<std::vector<std::uint8_t>>(*values)) {
    meanings.resize(std::max<std::size_t>(meanings.size(), value + 1U));
    stream >> meanings[value];
  }
  return meanings;
}

}  // namespace clatter::app
