#pragma once

#include <string>

#include "config/config.hpp"

namespace clatter::config {

/// A complete commented configuration that runs: every key with its default, meaning and range.
[[nodiscard]] std::string default_config(Format format);

}  // namespace clatter::config
