#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace verify {

using Json = nlohmann::json;

/// The beginning of a text of a file, without control characters.
[[nodiscard]] std::string shown(const std::string& text);

/// The JSON of a line. Throws FormatError if it is none, if an object has two members of one name, which says two
/// things at once, or if it holds more than any certificate does; and OutOfTime.
[[nodiscard]] Json json_of(const std::string& line);

}  // namespace verify
