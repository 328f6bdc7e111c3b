#pragma once

#include <optional>
#include <vector>

#include "branches/walk/opening.hpp"
#include "branches/walk/special_kind.hpp"
#include "branches/walk/touch.hpp"

namespace clatter::branches {

/// What becomes of a halt: one of a slip that sticks, of one that turns round, or none, as the slip goes on.
enum class HaltForm : std::uint8_t { stick, reversal, none };
/// An orbit with that form of a halt, and of all others that change at once with it, as those of its mirror image do.
[[nodiscard]] Orbit formed(const FollowedScene& scene, const Orbit& orbit, std::size_t halt, HaltForm form);

/// A change of the halts of a motion under dry friction: with the static level at the kinetic one a sliding bifurcation
/// (di Bernardo et al. 2008).
struct HaltChange {
  SpecialKind kind;
  Orbit orbit;                                 ///< near it, with the halt that the condition is on
  Condition condition;                         ///< that makes it exact
  std::optional<HaltForm> before{}, beyond{};  ///< of that halt; nothing: the motion isn't one of these
  std::optional<Opening::Kind> opens{};        ///< what begins from nothing beyond
};
/// The change at which the shortest slip to a halt vanishes, if it is about to, being shorter than some of the forcing
/// phase, rad: its beginning and the halt become one stick.
[[nodiscard]] std::optional<HaltChange> vanishing_slip(const OrbitEquations& equations, const CurvePoint& at,
                                                       double about_to_vanish = 0.1);

/// Whether a reversal on a stop, as an impact there loses its speed, is none: the static level of friction, which is
/// above the kinetic one, holds the mass. Motion jumps there.
[[nodiscard]] bool jumps_to_stick(const FollowedScene& scene, const Orbit& orbit, std::size_t reversal);

/// Whether a mass that sticks on a stop leaves it once it strikes that, as the kinetic level doesn't hold it.
[[nodiscard]] bool slips_on_from_stop(const FollowedScene& scene, const Orbit& orbit, std::size_t stick);

/// The changes that may be near an end of a branch with these violations beyond, the likeliest first; none if halts
/// don't end it. As a slip vanishes, rounding decides which violation is found.
[[nodiscard]] std::vector<HaltChange> halt_changes(const OrbitEquations& equations, const Narrowed& found,
                                                   const std::vector<Violation>& violations);

/// The scene and the motion of a change within a distance of the parameter, over the width of its range; nothing if
/// there is none. Motion that is its own mirror image there is kept as a half if all scenes that follow are symmetric.
[[nodiscard]] std::optional<ExactGraze> exact_change(const Equations& equations, const FollowedScene& near,
                                                     const HaltChange& change, bool symmetric_scenes, double within,
                                                     double tolerance);

/// Whether a slip is about to vanish so near that the parameter has no digits between there and here: then it may turn,
/// and measures with it, by rounding alone.
[[nodiscard]] bool slip_vanishes_beside(const Equations& builder, const OrbitEquations& walked, const CurvePoint& at,
                                        bool symmetric_scenes, double tolerance);

}  // namespace clatter::branches
