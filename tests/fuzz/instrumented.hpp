#pragma once

#include <cstdint>

namespace clatter::fuzz {

/// Whether an address is in instrumented code, which is clatter's and all in one piece.
[[nodiscard]] bool is_instrumented(std::uintptr_t address);

}  // namespace clatter::fuzz
