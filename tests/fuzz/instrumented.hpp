#pragma once

#include <cstdint>

namespace clatter::fuzz {

/// Whether an address is in instrumented code, that is in clatter's.
[[nodiscard]] bool is_instrumented(std::uintptr_t address);

}  // namespace clatter::fuzz
