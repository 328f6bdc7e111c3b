#pragma once

#include "dynamics/scene.hpp"
#include "lanes/lanes.hpp"
#include "numbers/arch.hpp"

namespace clatter {

/// The displacement and velocity of a lane at a forcing phase, given in turns since the last section.
struct LanePlace {
  double x, v, turns;
};

/// Whether a scene can go into a lane: motion under a force between stops, lightly damped, away from resonance, with
/// lengths and frequencies that leave an enclosure room.
[[nodiscard]] bool fits_lanes(const Scene& scene);

/// Makes a lane ready for a scene that meets the given stops, at its start.
void seat(Lanes& lanes, std::size_t lane, const Scene& scene, const Stops& stops);

/// Makes a lane stand still and report nothing.
void vacate(Lanes& lanes, std::size_t lane);

/// Where a lane stands.
[[nodiscard]] LanePlace place_of(const Lanes& lanes, std::size_t lane, const Scene& scene);

/// Moves a lane to another place.
void put(Lanes& lanes, std::size_t lane, const Scene& scene, const LanePlace& place);

/// Begins to observe a lane; where it `ends` with the next section, it may be `clipped` there.
void watch(Lanes& lanes, std::size_t lane, bool ends, bool clips);

/// Takes every lane on: to its next contact, past the next section, or by a few steps, whichever comes first.
using VisitLanes = void (*)(Lanes&);

/// The kernel for one instruction set, plain and with observers.
struct Visits {
  VisitLanes plain, observed;
};

/// Of an instruction set that this machine has; not scalar.
[[nodiscard]] Visits visits_of(Arch arch);

}  // namespace clatter
