#pragma once

#include <string>
#include <vector>

namespace clatter::app {

/// The help on a topic: a command, a key, a result, a section, a function of values, the whole configuration, all
/// results. A name that is several of these has the help on each. Throws UsageError if there is none.
[[nodiscard]] std::string help_on(const std::string& topic);

/// Every topic, commands first.
[[nodiscard]] std::vector<std::string> help_topics();

}  // namespace clatter::app
