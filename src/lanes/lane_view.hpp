#pragma once

#include "lanes/block_state.hpp"
#include "lanes/instruction_set.hpp"
#include "model/scene.hpp"

namespace clatter::lanes {

/// The displacement and velocity of a lane at a forcing phase, in turns since the last stroboscopic section.
struct LaneState {
  double x, v, phase_turns;
};

/// Whether a scene can run in a lane: forced motion between stops, lightly damped, away from resonance, with lengths
/// and frequencies that leave an enclosure room.
[[nodiscard]] bool accepts(const Scene& scene);

/// Loads a lane with a scene that meets the given stops, at its start.
void load_lane(BlockState& lanes, std::size_t lane, const Scene& scene, const Stops& stops);

/// Clears a lane: it stands still and reports nothing.
void clear_lane(BlockState& lanes, std::size_t lane);

/// The displacement x of a lane's y, its displacement from the load's equilibrium; that of a stop exactly.
[[nodiscard]] double x_of(const BlockState& lanes, std::size_t lane, const Scene& scene, double y);

/// The present state of a lane.
[[nodiscard]] LaneState state_of(const BlockState& lanes, std::size_t lane, const Scene& scene);

/// Sets the state of a lane.
void set_state(BlockState& lanes, std::size_t lane, const Scene& scene, const LaneState& state);

/// Begins to observe a lane. If observation `ends` at the next section, the lane may have to `stop_short` of it.
void begin_observing(BlockState& lanes, std::size_t lane, bool ends, bool stop_short);

/// Advances every lane: to its next contact, past the next section, or by a few steps, whichever comes first.
using StepFunction = void (*)(BlockState&);

/// The step functions of one instruction set, plain and with observers.
struct StepFunctions {
  StepFunction plain, observed;
};

/// The step functions for an instruction set that this machine has, not scalar.
[[nodiscard]] StepFunctions step_functions_of(InstructionSet arch);

}  // namespace clatter::lanes
