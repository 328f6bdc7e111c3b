#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace clatter::lanes {

/// Instruction sets for the computation of motion: one point at a time, or 2, 4, 8 in the lanes of a vector.
enum class InstructionSet : std::uint8_t { scalar, sse2, avx2, avx512 };

/// Names in the order of InstructionSet.
inline constexpr std::array<std::string_view, 4> instruction_set_names{"scalar", "sse2", "avx2", "avx512"};

[[nodiscard]] constexpr std::string_view name_of(InstructionSet arch) {
  return instruction_set_names[static_cast<std::size_t>(arch)];
}

[[nodiscard]] constexpr std::optional<InstructionSet> instruction_set_named(std::string_view name) {
  for (std::size_t i = 0; i < instruction_set_names.size(); ++i)
    if (instruction_set_names[i] == name) return static_cast<InstructionSet>(i);
  return std::nullopt;
}

/// The instruction sets whose lanes give the same bits as those of one: AVX2 and AVX-512 round alike.
[[nodiscard]] constexpr std::string_view name_of_bits(InstructionSet arch) {
  const bool is_fused = arch == InstructionSet::avx2 || arch == InstructionSet::avx512;
  return is_fused ? "avx2 or avx512" : name_of(arch);
}

/// Whether this machine and its system have the instruction set. avx2 stands for AVX2 and FMA, avx512 for its parts F,
/// DQ, CD, BW and VL: the compiler may use every part that the step functions are compiled for.
[[nodiscard]] inline bool is_supported(InstructionSet arch) {
  if (arch == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512vl");
  if (arch == InstructionSet::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return true;
}

/// The widest instruction set that this machine has.
[[nodiscard]] inline InstructionSet widest_instruction_set() {
  return is_supported(InstructionSet::avx512) ? InstructionSet::avx512
         : is_supported(InstructionSet::avx2) ? InstructionSet::avx2
                                              : InstructionSet::sse2;
}

/// The widest one that this machine has of those with such bits (`name_of_bits`); nothing: it has none of them.
[[nodiscard]] inline std::optional<InstructionSet> instruction_set_of_bits(std::string_view name) {
  std::optional<InstructionSet> widest;
  for (std::size_t i = 0; i < instruction_set_names.size(); ++i)
    if (const auto arch = static_cast<InstructionSet>(i); name_of_bits(arch) == name && is_supported(arch))
      widest = arch;
  return widest;
}

}  // namespace clatter::lanes
