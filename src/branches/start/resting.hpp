#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "branches/equations/equations.hpp"
#include "point/problem.hpp"

namespace clatter::branches {

/// The phase in 0 ... 2 pi at which the force takes a mass at rest off a stop: the pressing force is zero and falls.
/// Nothing if it always or never presses. A force of several orders may do so at several: it is the next one after a
/// phase, in rad.
[[nodiscard]] std::optional<double> release_phase(const FollowedScene& scene, Side stop, double after = 0);

/// The value of a parameter within a distance of the scene's at which the release from a stop, at a phase near
/// `release`, vanishes as the force still presses at its crest: spring, load and force balance. Nothing if there is
/// none.
[[nodiscard]] std::optional<double> release_tangency(const FollowedScene& scene, Side stop, double release,
                                                     Parameter parameter, double within);

/// The periodic motion that rests on a stop until its release from there, and again after at most so many forcing
/// periods: the run from the release is all there is to find. It begins with the first impact after the release; its
/// last element is that rest. Nothing if the run doesn't come back to rest.
[[nodiscard]] std::optional<Orbit> resting_orbit(const point::Problem& problem, Side stop, std::int64_t most_periods);

/// A resting motion, kept as a half if it is released from the opposite stops of a symmetric scene half a period apart:
/// the rest follows, and only the impacts of a chatter that are too slow to matter may differ in number.
[[nodiscard]] Orbit half_of_resting(const Orbit& orbit, bool symmetric_scene);

/// The impacts of a resting motion as letters, each chatter that ends in a rest as one: the impacts on the same stop
/// before it that get slower and slower. A contact with a soft stop is one, too, and each renewal of it is another.
[[nodiscard]] std::string letters_of(const Orbit& orbit);

/// Of each impact, whether it is a letter, or the rest whose chatter is one.
[[nodiscard]] std::vector<bool> are_letters(const Orbit& orbit);

/// The speed of the slowest impact that is no part of such a chatter; infinite without one.
[[nodiscard]] double slowest_letter(const Orbit& orbit);

}  // namespace clatter::branches
