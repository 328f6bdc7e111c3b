#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "attractors/exact_run.hpp"

namespace clatter::attractors {

/// Motions that agree to this share of their size are the same.
inline constexpr double same_motion = 1e-9;

/// A periodic motion at given parameters.
struct PeriodicMotion {
  std::vector<SectionState>
      cycle{};                   ///< its states at forcing phase 0 in successive periods, as many as it takes to repeat
  std::string word{}, regime{};  ///< as `ImpactWord` gives them
  double size = 0.0;             ///< the largest number of a state at forcing phase 0, or impact speed
  double middle_of_flight = 0.0;  ///< of the longest one, in forcing periods from cycle[0] on
  bool contracts = false;         ///< it shrinks areas of states: else it is one of a family, and no attractor
  bool floats = false;            ///< no wall meets a loose mass, here or anywhere in a band of its housing: it is
                                  ///< the motion of the main mass alone,
  bool rubs = false;              ///< or one whose friction is the same at all of these places

  /// Whether a state at forcing phase 0 is one of its own.
  [[nodiscard]] bool passes(const SectionState& state) const;
};

/// The motion of period 1 or more forcing periods that a state at forcing phase 0 is near, made exact by Newton's
/// method as long as that brings it closer to a repeat; nothing if the run fails. Motion that grazes a stop, or rests
/// in every period, stays as it is. With another `phase`, in rad, all states are those at that.
[[nodiscard]] std::optional<PeriodicMotion> periodic_motion(const point::Problem& problem, SectionState state,
                                                            std::size_t periods, double phase = 0.0);

/// A mass that stands still without a force, with a loose one at its place in the housing.
[[nodiscard]] PeriodicMotion standstill(const point::Problem& problem, const SectionState& state);

/// A state on a stop, or of a loose mass on a wall, to the accuracy to which motions are compared, that moves into it:
/// the state after the impact.
[[nodiscard]] SectionState after_impact(const Scene& scene, SectionState state, double size);

/// The state at forcing phase 0 of the mirror image of a motion: half a period after `state`, mirrored; nothing if the
/// run fails.
[[nodiscard]] std::optional<SectionState> mirrored(const point::Problem& problem, const SectionState& state);

}  // namespace clatter::attractors
