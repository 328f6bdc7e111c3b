#pragma once

#include "certificate.hpp"
#include "field.hpp"

namespace verify {

/// Reads the scene of a certificate. Throws FormatError.
[[nodiscard]] Certificate::SceneNumbers scene_of(const Field& field);

}  // namespace verify
