#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace clatter {

/// Instruction sets that motion is computed with: one point at a time, or 2, 4, 8 in the lanes of a vector.
enum class Arch : std::uint8_t { scalar, sse2, avx2, avx512 };

/// In the order of Arch.
inline constexpr std::array<std::string_view, 4> arch_names{"scalar", "sse2", "avx2", "avx512"};

[[nodiscard]] constexpr std::string_view name_of(Arch arch) { return arch_names[static_cast<std::size_t>(arch)]; }

[[nodiscard]] constexpr std::optional<Arch> arch_named(std::string_view name) {
  for (std::size_t i = 0; i < arch_names.size(); ++i)
    if (arch_names[i] == name) return static_cast<Arch>(i);
  return std::nullopt;
}

/// Whether this machine and its system have the instruction set. avx2 stands for AVX2 and FMA, avx512 for its parts F
/// and DQ.
[[nodiscard]] inline bool runs_here(Arch arch) {
  if (arch == Arch::avx512) return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  if (arch == Arch::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return true;
}

/// The widest that this machine has.
[[nodiscard]] inline Arch best_arch() {
  return runs_here(Arch::avx512) ? Arch::avx512 : runs_here(Arch::avx2) ? Arch::avx2 : Arch::sse2;
}

}  // namespace clatter
