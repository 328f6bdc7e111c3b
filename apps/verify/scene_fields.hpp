#pragma once

#include <vector>

#include "certificate.hpp"
#include "field.hpp"

namespace verify {

/// Further orders of a force, or their slopes, each once. Throws FormatError.
[[nodiscard]] std::vector<Certificate::OrderNumbers> orders_of(const Field& field);

/// Reads the scene of a certificate. Throws FormatError.
[[nodiscard]] Certificate::SceneNumbers scene_of(const Field& field);

}  // namespace verify
