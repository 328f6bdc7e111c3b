#pragma once

#include <string>

namespace clatter::app {

/// The help on a topic: a command, a key, a section, a function of values, or the whole configuration. Throws
/// UsageError if there is none.
[[nodiscard]] std::string help_on(const std::string& topic);

}  // namespace clatter::app
