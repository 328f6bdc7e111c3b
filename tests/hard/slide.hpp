#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace clatter::hard {

/// One event of the motion of a mass with dry friction.
struct SlideEvent {
  enum class Kind : std::uint8_t {
    impact,      ///< on a rigid stop
    rest,        ///< on a rigid stop
    touch,       ///< of a soft stop at its position
    renewal,     ///< of the contact with a soft stop, beyond its position
    separation,  ///< from a soft stop
    stick,       ///< away from rigid stops
    reversal,    ///< the velocity passes 0
    chatter,     ///< of the program's motions: impacts on a stop that it doesn't tell one by one
  };
  using Real = long double;

  Kind kind;
  Side side = Side::none;      ///< of the stop
  Real time = 0;               ///< tau
  Real velocity = 0;           ///< before an impact, at a touch, renewal or separation
  Real until = 0;              ///< the end of a rest or stick, tau
  Real place = 0;              ///< displacement of a stick or reversal
  Real before = 0, after = 0;  ///< accelerations at a reversal; before a stick into which a slip ends
};

/// A motion from its start.
struct SlideRun {
  using Real = SlideEvent::Real;

  std::vector<SlideEvent> events{};
  Real x = 0, v = 0;             ///< at the end
  Real lowest = 0, highest = 0;  ///< extreme displacements
  Real fastest = 0;              ///< the largest speed at the beginning or the end of a flight
  Real stuck = 0;                ///< time in sticks, tau
  Real rubbed = 0;               ///< energy lost to friction
  bool completed = false;        ///< false: more events than allowed
};

/// Simulates a scene with dry friction,
///   x'' + 2h x' + k x + mu sgn x' = f sin(nu tau + phase) + load,
/// between rigid or soft stops at rest, by Taylor series in long double. It shares the numbers of the scene with the
/// program and nothing else: no closed form, no root finder, no sum over chatter. Impacts are followed one by one until
/// a rebound has less than 1e-16 of the fastest speed. `rounding` moves each place at which the velocity falls to 0, in
/// parts of the displacement, but by a millionth of the height of a flight at most: the effect of a coarser arithmetic.
[[nodiscard]] SlideRun slide(const Scene& scene, SlideEvent::Real duration, std::size_t most_events = 4000,
                             SlideEvent::Real rounding = 0);

}  // namespace clatter::hard
