#pragma once

#include "scene/key.hpp"

namespace clatter::config {

/// The key of the shape of the force, in [scene] or in [machine].
[[nodiscard]] Key force_shape_key(bool is_si);
/// The key of a force as it was measured.
[[nodiscard]] Key force_table_key(bool is_si);
/// The key of the orders of that which are taken.
[[nodiscard]] Key force_table_harmonics_key(bool is_si);

}  // namespace clatter::config
