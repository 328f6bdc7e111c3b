#pragma once

#include <string>
#include <vector>

#include "config/config.hpp"
#include "support/temporary_directory.hpp"

namespace clatter::config {

/// The configuration that a text means; the name says whether it is TOML or INI.
inline Config read_as(const std::string& name, const std::string& text, const std::vector<Override>& overrides = {}) {
  const support::TemporaryDirectory directory;
  return read_config(directory.write(name, text), overrides);
}

/// The error message for a text, e.g. "a.toml:2:5: ..."; empty if nothing is.
inline std::string mistake_in(const std::string& name, const std::string& text,
                              const std::vector<Override>& overrides = {}) {
  const support::TemporaryDirectory directory;
  try {
    (void)read_config(directory.write(name, text), overrides);
  } catch (const ConfigError& error) {
    const std::string message = error.what();
    return message.starts_with(directory.path("")) ? message.substr(directory.path("").size()) : message;
  }
  return {};
}

}  // namespace clatter::config
