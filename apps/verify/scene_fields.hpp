#pragma once

#include "certificate.hpp"
#include "field.hpp"

namespace verify {

constexpr long most_order = 100;  ///< of a force

/// Reads the scene of a certificate. Throws FormatError.
[[nodiscard]] Certificate::SceneNumbers scene_of(const Field& field);

}  // namespace verify
