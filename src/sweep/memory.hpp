#pragma once

#include "sweep/sweep.hpp"

namespace clatter {

/// Bytes that the results of a sweep take; the impact log, whose length nobody knows beforehand, comes on top.
[[nodiscard]] double result_bytes(const Sweep& sweep);

/// Bytes in memory at the end of a run, so that a sweep that cannot fit is refused before hours of computing: the
/// results, each variable of which leaves once it is in the file's image, and the largest of them in both places.
[[nodiscard]] double run_bytes(const Sweep& sweep);

/// Memory of this machine in bytes; 0 where it isn't told.
[[nodiscard]] double machine_bytes();

}  // namespace clatter
