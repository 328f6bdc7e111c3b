#pragma once

#include "lanes/block_state.hpp"
#include "lanes/instruction_set.hpp"
#include "model/scene.hpp"

namespace clatter::lanes {

/// The displacement and velocity of a lane at a forcing phase, given in turns since the last section.
struct LaneState {
  double x, v, turns;
};

/// Whether a scene can go into a lane: motion under a force between stops, lightly damped, away from resonance, with
/// lengths and frequencies that leave an enclosure room.
[[nodiscard]] bool accepts(const Scene& scene);

/// Makes a lane ready for a scene that meets the given stops, at its start.
void load_lane(BlockState& lanes, std::size_t lane, const Scene& scene, const Stops& stops);

/// Makes a lane stand still and report nothing.
void clear_lane(BlockState& lanes, std::size_t lane);

/// Where a lane stands.
[[nodiscard]] LaneState place_of(const BlockState& lanes, std::size_t lane, const Scene& scene);

/// Moves a lane to another place.
void put(BlockState& lanes, std::size_t lane, const Scene& scene, const LaneState& place);

/// Begins to observe a lane; where it `ends` with the next section, it may be `clipped` there.
void watch(BlockState& lanes, std::size_t lane, bool ends, bool stop_short);

/// Takes every lane on: to its next contact, past the next section, or by a few steps, whichever comes first.
using StepFunction = void (*)(BlockState&);

/// The kernel for one instruction set, plain and with observers.
struct StepFunctions {
  StepFunction plain, observed;
};

/// Of an instruction set that this machine has; not scalar.
[[nodiscard]] StepFunctions step_functions_of(InstructionSet arch);

}  // namespace clatter::lanes
