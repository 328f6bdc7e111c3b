#pragma once

#include <string>
#include <string_view>

#include "config/config_error.hpp"

namespace clatter::config {

/// The size of the largest configuration that is read.
inline constexpr std::size_t max_config_bytes = std::size_t{1} << 20;
/// Beside the rows of a measured force, which may have as many.
inline constexpr std::size_t max_table_bytes = std::size_t{8} << 20;

/// Whether the name of a file has an ending, in any case; `ending` is in lower case.
[[nodiscard]] bool has_ending(std::string_view name, std::string_view ending);

/// The whole file, without a byte-order mark. Throws IoError if it cannot be read or isn't text.
[[nodiscard]] std::string read_text(const std::string& path);
/// The same of a file with the rows of a measured force.
[[nodiscard]] std::string read_table(const std::string& path);

/// All of standard input, likewise; errors call it `name`.
[[nodiscard]] std::string read_standard_input(const std::string& name);

/// The location of a byte in a text: lines end with \n, columns count characters.
[[nodiscard]] SourceLocation location_of(const std::string& file, std::string_view text, std::size_t offset);

/// The text without the pair of quotes around it, if there is one.
[[nodiscard]] std::string unquoted(std::string_view text);

/// The text without the blanks around it.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// Throws ConfigError at the first control character or byte that isn't UTF-8.
void check_characters(const std::string& file, std::string_view text);

}  // namespace clatter::config
