#pragma once

#include <cstddef>
#include <optional>

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// Why a solution of the equations is no motion between stops.
struct Violation {
  enum class Kind : std::uint8_t {
    passes_through,  ///< a flight meets a stop before its end; or a soft stop's force rises or falls to zero before it
    pulls,           ///< an impact's velocity points away from its stop; an event within a soft stop lies outside
    no_rebound,      ///< an impact is so slow that the mass doesn't rebound
    at_once,         ///< a flight meets a stop or a wall just as it ends with an event of the other mass
    ends_early,      ///< a contact with a soft stop, or its interruption, ends before it begins
    halts,           ///< the velocity falls to 0 before a flight's end
    runs_on,         ///< the mass isn't slowed down as it comes to a stick
    sticks,          ///< the mass isn't pushed away from a reversal as hard as the static level of friction
    slips,           ///< friction doesn't hold the mass at a stick, or not for so long
    stays,           ///< nothing releases it from a stick
    vanishes,        ///< a slip to a stick has no length, which solves its equations at any speed
    ceases           ///< friction is up to the force, and all slips are about to vanish
  };
  Kind kind = Kind::passes_through;
  std::size_t event = 0;  ///< its number: that of the flight's beginning, or of the event that is wrong itself
  OrbitEvent turning{};   ///< passes_through: the turning point beyond the stop, as an impact without speed; or the
                          ///< extremum of the soft stop's force, as an event that changes nothing; halts: that of the
                          ///< velocity, as a stick; at_once: where the flight would turn
};

/// Where two events of a soft stop are about to vanish, the proof may find a third one beside them: it is theirs.
[[nodiscard]] Violation told_apart(const SceneNumbers<double>& p, const Orbit& orbit, const Violation& found);

/// The first violation of an orbit, by the proof of first contact on each of its flights, and by that of the first sign
/// change of a soft stop's force; nothing: it is a motion. The event `grazing` may be without speed.
[[nodiscard]] std::optional<Violation> violation(const FollowedScene& scene, const Orbit& orbit,
                                                 std::optional<std::size_t> grazing = {});
/// Of a point of a branch or a curve.
[[nodiscard]] inline std::optional<Violation> violation(const OrbitEquations& equations, const Vector& point) {
  return violation(equations.scene_at(point), equations.orbit_at(point), equations.grazing());
}

}  // namespace clatter::branches
