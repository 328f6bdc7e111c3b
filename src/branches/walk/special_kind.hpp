#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace clatter::branches {

/// Special points of branches and of curves in two parameters.
enum class SpecialKind : std::uint8_t {
  fold,
  flip,
  symmetry_breaking,
  graze,
  chatter_limit,      ///< a chatter ends in rest just at the release: beyond it the mass doesn't rest
  release_tangency,   ///< beyond it the mass is never released, or earlier
  impact_speed,       ///< largest along the branch
  impact_power,       ///< likewise
  harmonic,           ///< likewise
  resonant_graze,     ///< of a curve: an impact that vanishes on curves of multipliers +1 and -1
  cusp,               ///< of a curve: two special points meet and vanish
  crossing_sliding,   ///< under dry friction: a reversal of a slip becomes a stick, or the other way round
  grazing_sliding,    ///< likewise: a slip whose velocity just comes to 0 gains a stick, or the other way round
  switching_sliding,  ///< likewise: a reversal and the slip to a stick vanish, or appear before it
  neimark_sacker,     ///< of a loose mass: a pair of multipliers leaves the unit circle
  motion_ceases,      ///< under dry friction: it comes up to the force, and beyond holds the mass for good
  simultaneous,       ///< of a loose mass: an event of each of the two masses at the same instant
  rebound_threshold,  ///< an impact comes down to the speed below which the mass doesn't rebound
  strong_resonance    ///< of a curve of Neimark-Sacker points: the pair of multipliers comes to 1 or -1
};
[[nodiscard]] constexpr std::string_view name_of(SpecialKind kind) {
  constexpr std::array<std::string_view, 19> names{"fold",
                                                   "flip",
                                                   "symmetry breaking",
                                                   "graze",
                                                   "chatter limit",
                                                   "release tangency",
                                                   "maximum impact_speed",
                                                   "maximum impact_power",
                                                   "maximum harmonic",
                                                   "resonant graze",
                                                   "cusp",
                                                   "crossing-sliding",
                                                   "grazing-sliding",
                                                   "switching-sliding",
                                                   "Neimark-Sacker",
                                                   "motion ceases",
                                                   "simultaneous events",
                                                   "rebound threshold",
                                                   "strong resonance"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace clatter::branches
