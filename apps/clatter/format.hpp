#pragma once

#include <string>

namespace clatter::app {

/// A number in a printf format for one double.
[[nodiscard]] std::string formatted(const char* format, double value);

/// "1 point", "2 points".
[[nodiscard]] std::string counted(double count, const char* noun);

/// "12.5 KiB", "1.25 GiB".
[[nodiscard]] std::string bytes_text(double bytes);

/// A text as JSON, with quotes. Bytes that aren't UTF-8 become U+FFFD, since JSON is text.
[[nodiscard]] std::string json_text(const std::string& text);

/// A number as JSON; null unless it is finite.
[[nodiscard]] std::string json_number(double value);

}  // namespace clatter::app
