#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hard/machine.hpp"
#include "motion/event.hpp"
#include "scene/scene.hpp"

namespace clatter::hard {

/// One event of a motion as the program and the simulator both tell it. Walls of a loose mass are as stops of it.
struct ToldEvent {
  enum class Kind : std::uint8_t {
    impact,      ///< on a rigid stop or a wall
    rest,        ///< on a rigid stop, or of a loose mass that a wall presses
    touch,       ///< of a soft stop at its position
    renewal,     ///< of the contact with a soft stop, beyond its position
    separation,  ///< from a soft stop
    stick,       ///< away from rigid stops
    reversal,    ///< the velocity passes 0
    chatter,     ///< of the program's motions: impacts on a stop that it doesn't tell one by one
  };
  using Real = long double;

  Kind kind;
  Side side = Side::none;      ///< of the stop or wall
  Real time = 0;               ///< tau
  Real velocity = 0;           ///< before an impact, at a touch, renewal or separation
  Real until = 0;              ///< the end of a rest or stick, tau
  Real place = 0;              ///< displacement of a stick or reversal, or of the main mass at an impact on a wall
  Real before = 0, after = 0;  ///< velocities of the main mass at an impact on a wall
  Real pull = 0;               ///< of the simulator's motions, as there
};
[[nodiscard]] std::vector<ToldEvent> told_events(const std::vector<motion::Event>& events);
[[nodiscard]] std::vector<ToldEvent> told_events(const MachineRun& run);

/// The scales of a motion, to which deviations are relative: its length, and the largest displacement and speed of it
/// or of the response to the force, since a flight is a difference of terms of that size.
struct Scales {
  double duration, size, fastest;
};
[[nodiscard]] Scales scales_of(const Scene& scene, double duration, const MachineRun& run);

/// Events without stands too short to be told from none, and those that sections cut joined.
[[nodiscard]] std::vector<ToldEvent> joined(const std::vector<ToldEvent>& events, double duration);

/// The largest relative difference of two events of one kind.
[[nodiscard]] double deviation_of(const ToldEvent& event, const ToldEvent& reference, const Scales& scales);

/// Events of two runs that are the same.
struct EventMatch {
  std::vector<std::pair<std::size_t, std::size_t>> pairs{};  ///< places in both lists
  std::size_t first_difference = 0;  ///< place in the reference from which on no events were matched
  std::string difference{};          ///< the first one; empty: none up to the end, or to that of a list cut short
};

/// Pairs the events of a run with those of the reference, in their order. Impacts of a chatter that only one of the two
/// tells have no partner, nor has an event within `at_the_end` of the end, over the duration.
[[nodiscard]] EventMatch match(const std::vector<ToldEvent>& events, bool is_cut,
                               const std::vector<ToldEvent>& reference, bool reference_is_cut, const Scales& scales);

}  // namespace clatter::hard
