#include "config/look_alike.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "storage/utf8.hpp"

namespace clatter::config {
namespace {

/// A range of typeset characters that stand for a plain one.
struct LookAlike {
  char32_t first, last;
  std::string_view kind, type;
};

constexpr std::string_view typeset_minus = "a typeset minus", typeset_sign = "a typeset sign",
                           typeset_quote = "a typeset quote", typeset_blank = "a typeset blank",
                           straight_quote = "a straight quote, \"", plain_blank = "a plain blank";

constexpr std::array look_alikes{
    LookAlike{0x2212, 0x2212, typeset_minus, "a hyphen, -"},
    LookAlike{0x2010, 0x2015, "a typeset dash", "a hyphen, -"},
    LookAlike{0xFE63, 0xFE63, typeset_minus, "a hyphen, -"},
    LookAlike{0xFF0D, 0xFF0D, typeset_minus, "a hyphen, -"},
    LookAlike{0x2260, 0x2260, typeset_sign, "!="},
    LookAlike{0x2264, 0x2264, typeset_sign, "<="},
    LookAlike{0x2265, 0x2265, typeset_sign, ">="},
    LookAlike{0x2018, 0x201F, typeset_quote, straight_quote},
    LookAlike{0xAB, 0xAB, typeset_quote, straight_quote},
    LookAlike{0xBB, 0xBB, typeset_quote, straight_quote},
    LookAlike{0x2039, 0x203A, typeset_quote, straight_quote},
    LookAlike{0xA0, 0xA0, "a no-break space", plain_blank},
    LookAlike{0x2000, 0x200A, typeset_blank, plain_blank},
    LookAlike{0x202F, 0x202F, typeset_blank, plain_blank},
    LookAlike{0x205F, 0x205F, typeset_blank, plain_blank},
    LookAlike{0x3000, 0x3000, typeset_blank, plain_blank},
    LookAlike{0x200B, 0x200D, "an invisible character", "none"},
    LookAlike{0xFEFF, 0xFEFF, "an invisible character", "none"},
};

}  // namespace

std::string name_of_character(std::string_view character) {
  const auto number = static_cast<unsigned>(storage::code_point(character));
  std::array<char, 16> digits{};
  std::snprintf(digits.data(), digits.size(), "U+%04X", number);
  const auto is_blank = [&](const LookAlike& one) {
    return number >= one.first && number <= one.last && (one.type == plain_blank || one.type == "none");
  };
  if (storage::is_obeyed(character) || std::ranges::any_of(look_alikes, is_blank)) return digits.data();
  return '\'' + std::string(character) + "' (" + digits.data() + ')';
}

std::optional<std::string> look_alike_hint(std::string_view character) {
  const char32_t number = storage::code_point(character);
  const auto found = std::ranges::find_if(
      look_alikes, [&](const LookAlike& one) { return number >= one.first && number <= one.last; });
  if (found == look_alikes.end()) return std::nullopt;
  const std::string what_to_do = found->type == "none" ? "; delete it" : "; type " + std::string(found->type);
  return name_of_character(character) + " is " + std::string(found->kind) + what_to_do;
}

std::optional<FoundLookAlike> find_look_alike(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(storage::utf8_length(text.substr(at)), 1);
    if (auto hint = length > 1 ? look_alike_hint(text.substr(at, length)) : std::nullopt)
      return FoundLookAlike{at, std::move(*hint)};
    at += length;
  }
  return std::nullopt;
}

}  // namespace clatter::config
