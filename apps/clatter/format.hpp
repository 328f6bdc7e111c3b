#pragma once

#include <string>

namespace clatter::app {

/// A number by a printf format for one double.
[[nodiscard]] std::string formatted(const char* format, double value);

/// "1 point", "2 points".
[[nodiscard]] std::string counted(double count, const char* noun);

/// "12.5 KiB", "1.25 GiB".
[[nodiscard]] std::string bytes_text(double bytes);

/// A text as JSON, quotes included; bytes that are no UTF-8 become U+FFFD, since JSON has no bytes.
[[nodiscard]] std::string json_text(const std::string& text);

/// A number as JSON, which knows no infinity: null.
[[nodiscard]] std::string json_number(double value);

}  // namespace clatter::app
