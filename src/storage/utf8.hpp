#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace clatter::storage {

/// Bytes of the UTF-8 character that begins the text, 0 where none does; the text isn't empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// The code point of a character.
[[nodiscard]] char32_t code_point(std::string_view character);

/// Whether a terminal does something with a character beyond showing it, or shows nothing: control characters, marks of
/// direction, separators of lines, characters without width.
[[nodiscard]] bool is_obeyed(std::string_view character);

/// Number of characters of UTF-8 text.
[[nodiscard]] int characters(std::string_view text);

/// A text in one line that a terminal shows and does not obey: what `is_obeyed`, and bytes that aren't UTF-8, as
/// \x1b. For all that comes from elsewhere: files, their names, the command line.
[[nodiscard]] std::string printable(std::string_view text);

/// The same for a text of any length: its beginning.
[[nodiscard]] std::string excerpt(std::string_view text);

/// The same in single quotes: the name of a file in a message.
[[nodiscard]] std::string quoted_name(std::string_view text);

/// The same for a text of several lines, which stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// Where the text has its first byte that isn't UTF-8, or npos.
[[nodiscard]] std::size_t find_not_utf8(std::string_view text);

}  // namespace clatter::storage
