#pragma once

#include "certificate.hpp"

namespace verify {

/// Throws Refuted if no motion of the scene has the claimed events in this order, wherever it starts.
void require_possible_order(const Certificate& certificate);

}  // namespace verify
