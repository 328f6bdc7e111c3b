#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clatter::config {

/// A character as a message names it: "'−' (U+2212)"; one that shows nothing by its number alone.
[[nodiscard]] std::string name_of_character(std::string_view character);

/// The plain character that a typeset one stands for, and what to type, for a message: "'−' (U+2212) is a typeset
/// minus; type -". Word processors and web pages put them in place of those of a keyboard. Nothing: it is none.
[[nodiscard]] std::optional<std::string> look_alike_hint(std::string_view character);

/// The first such character of a text: where it begins, and its hint.
struct FoundLookAlike {
  std::size_t at;
  std::string hint;
};
[[nodiscard]] std::optional<FoundLookAlike> find_look_alike(std::string_view text);

}  // namespace clatter::config
