#pragma once

#include <array>
#include <vector>

#include "attractors/section_state.hpp"
#include "branches/equations/equations.hpp"
#include "observables/extremes/extrema.hpp"

namespace clatter::branches {

/// Multipliers of an orbit over its whole period, and whether all lie within the unit circle. A rest forgets all that
/// went before it: they are zero then.
struct Multipliers {
  std::array<double, 4> re{}, im{};  ///< the one of larger modulus first; without a loose mass two
  bool stable = true;
};
/// How many multipliers there are: one for each number of a state.
[[nodiscard]] inline std::size_t multipliers_in(const Scene& scene) { return has_loose_mass(scene.loose) ? 4 : 2; }
[[nodiscard]] Multipliers multipliers(const FollowedScene& scene, const Orbit& orbit);

/// The state at a phase after event i of an orbit and before the next, neither of which is a rest; at any phase of
/// motion without events.
[[nodiscard]] attractors::SectionState state_at(const FollowedScene& scene, const Orbit& orbit, std::size_t i,
                                                double phase);
/// The states of a period at which the forcing phase is `phase`; if rounding decides whether an impact comes before
/// such an instant, one may be missing.
[[nodiscard]] std::vector<attractors::SectionState> states_at_phase(const FollowedScene& scene, const Orbit& orbit,
                                                                    double phase);
/// The state when the forcing phase is 0.
[[nodiscard]] attractors::SectionState state_at_phase_zero(const FollowedScene& scene, const Orbit& orbit);

/// Least and greatest displacement and velocity, which meet rigid stops to rounding; of a loose mass those of y and z.
[[nodiscard]] observables::Extrema::Values extrema(const FollowedScene& scene, const Orbit& orbit);
/// The extrema in the frame in which a scene is computed, which with a loose mass on a shaken base is that of the
/// ground.
[[nodiscard]] observables::Extrema::Values extrema_as_computed(const FollowedScene& scene, const Orbit& orbit);

/// Speed of the fastest impact on stops, and on walls that have no letters of their own.
[[nodiscard]] double impact_speed(const Orbit& orbit, const WordLetters& letters = {});
/// Of the fastest one on walls.
[[nodiscard]] double wall_impact_speed(const Orbit& orbit);
/// Energy lost on the stops per tau, of the mass over that at the start: in impacts (eq. 33), in contacts with soft
/// stops (eq. 54); a chatter that ends in rest loses all that it has.
[[nodiscard]] double impact_power(const FollowedScene& scene, const Orbit& orbit);

}  // namespace clatter::branches
