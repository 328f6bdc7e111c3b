#pragma once

#include <span>

#include "model/key.hpp"

namespace clatter::config {

/// The keys of [machine]: a scene in SI.
[[nodiscard]] std::span<const Key> machine_keys();

}  // namespace clatter::config
