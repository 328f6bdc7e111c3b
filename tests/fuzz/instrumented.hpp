#pragma once

#include <cstdint>

namespace clatter::fuzz {

/// Whether an address is in instrumented code, which is clatter's.
[[nodiscard]] bool is_instrumented(std::uintptr_t address);

}  // namespace clatter::fuzz
