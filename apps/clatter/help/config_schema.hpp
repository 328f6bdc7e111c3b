#pragma once

#include <string>

namespace clatter::app {

/// The key table as a JSON Schema (draft 7), by which editors complete and check a configuration in TOML: sections,
/// keys, their help, kinds, ranges, choices and defaults, and how texts stand for numbers. Units are checked by their
/// form alone; that they fit, and that keys go together, a run checks.
[[nodiscard]] std::string config_schema();

}  // namespace clatter::app
