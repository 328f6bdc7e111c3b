#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace clatter::hard {

/// A main mass that carries a loose one between two walls, in the simulator's own terms:
///   x'' + 2h x' + k x = f sin(nu tau + phase) + load + b (k sin + 2 h nu cos)(nu tau + phase),
///   y'' = loose_load, z = y - x between the walls; an impact has z' -> -R z', x' -> x' + eps (1 + R) z'/(1 + eps).
struct CarryScene {
  double damping = 0, stiffness = 1, forcing = 0, frequency = 1, phase = 0, load = 0;
  double base_amplitude = 0;  ///< b: the base is shaken by b sin(nu tau + phase); x counts from the ground
  double loose_mass = 0.1;    ///< eps
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  double restitution = 1, loose_load = 0;
  double x = 0, v = 0;  ///< of the main mass at the start
  double z = 0, w = 0;  ///< of the loose mass at the start, as seen from the main one
};

/// One event of the motion of such a pair.
struct CarryEvent {
  enum class Kind : std::uint8_t {
    impact,   ///< of the loose mass on a wall
    carried,  ///< the wall takes the loose mass along
  };
  using Real = long double;

  Kind kind;
  int side;           ///< 1: the upper wall, -1: the lower one
  Real time;          ///< tau
  Real w = 0;         ///< z' before an impact
  Real until = 0;     ///< the end of a carried time, tau
  Real x = 0;         ///< of the main mass
  Real before = 0;    ///< x' before
  Real after = 0;     ///< x' after
  Real pressing = 0;  ///< z'' with which the loose mass is pressed when the wall takes it along
};

/// The least and the greatest of a quantity.
struct Range {
  long double least = std::numeric_limits<long double>::infinity(), greatest = -least;
  void take(long double value) {
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
};

/// A motion from its start.
struct CarryRun {
  using Real = CarryEvent::Real;

  std::vector<CarryEvent> events{};
  Real x = 0, v = 0, z = 0, w = 0;  ///< at the end
  Range of_x{}, of_y{}, of_z{};     ///< extremes
  Real fastest = 0;                 ///< the largest |z'|
  Real fastest_main = 0;            ///< the largest |x'| at the beginning or the end of a Taylor step
  Real work = 0;                    ///< of all forces but the spring and the damper; the main mass is 1
  Real damped = 0;                  ///< energy lost to the damper
  Real struck = 0;                  ///< energy lost in impacts after the start
  Real stored = 0;         ///< energy of both masses and the spring at the end, less that after an impact at the start
  bool completed = false;  ///< false: more events than allowed, or an endless change between two phases
};

/// Simulates such a scene by Taylor series in long double. It shares nothing with the program: no closed form, no root
/// finder, no sum over chatter. Impacts are followed one by one until a rebound has less than 1e-16 of the fastest z'.
[[nodiscard]] CarryRun carry(const CarryScene& scene, CarryEvent::Real duration, std::size_t most_events = 4000);

/// The same in less time, without extremes and energies. `rounding` lets each impact come late by so many parts of x,
/// but by a millionth of the height of a flight at most, and each release by as many of the accelerations: the effect
/// of a coarser arithmetic on their differences.
[[nodiscard]] CarryRun carry_events(const CarryScene& scene, CarryEvent::Real duration, std::size_t most_events,
                                    CarryEvent::Real rounding);

}  // namespace clatter::hard
