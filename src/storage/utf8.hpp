#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace clatter::storage {

/// Number of bytes of the UTF-8 character that begins the text, 0 if none does; the text mustn't be empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// The code point of a character.
[[nodiscard]] char32_t code_point(std::string_view character);

/// Whether a terminal obeys a character instead of showing it, or shows nothing: control characters, marks of
/// direction, separators of lines, characters without width.
[[nodiscard]] bool is_obeyed(std::string_view character);

/// Number of characters of UTF-8 text.
[[nodiscard]] int characters(std::string_view text);

/// A text in one line that a terminal shows and does not obey: characters that it would obey, and bytes that aren't
/// UTF-8, are written as \x1b. For all text from outside: files, their names, the command line.
[[nodiscard]] std::string printable(std::string_view text);

/// The beginning of a text of any length, `most` bytes of it, made printable.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t most = 200);

/// A text made printable, in single quotes: the name of a file in a message.
[[nodiscard]] std::string quoted_name(std::string_view text);

/// A text of several lines made printable; line breaks stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// Index of the first byte of the text that isn't UTF-8, or npos.
[[nodiscard]] std::size_t find_not_utf8(std::string_view text);

}  // namespace clatter::storage
