#pragma once

#include "sweep/sweep.hpp"

namespace clatter {

/// Bytes that the results of a sweep take in memory, so that one that cannot fit is refused before hours of computing;
/// the impact log, whose length nobody knows beforehand, comes on top.
[[nodiscard]] double result_bytes(const Sweep& sweep);

}  // namespace clatter
