#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace clatter::hard {

inline constexpr double no_stop = std::numeric_limits<double>::infinity();

/// How the restitution of a stop or wall depends on the speed v of the impact, beside its plain number R: not at all,
/// as 1 - (1 - R) (v/V)^p, but no less than p/(1 + p), or by knots in place of both, along straight lines between them.
struct Law {
  struct Knot {
    double speed, R;
  };
  double exponent = 0, reference = 1;  ///< p, 0: R at each speed; and V
  double below = 0;                    ///< slower impacts leave no speed, by any law
  std::vector<Knot> knots{};           ///< by rising speed
  double unit = 1;                     ///< of their speeds
};

/// The shape s of the force over the angle theta, of period 2 pi.
enum class ForceShape : std::uint8_t {
  sine,
  square,     ///< 1 on the first `duty` of the period, else -1
  pulse,      ///< 1 there, else 0
  triangle,   ///< straight lines between the zeros and peaks of the sine
  trapezoid,  ///< straight from -1 to 1 within `rise` of the period, around theta = 0, and back around theta = pi
  sawtooth,   ///< theta/pi - 1, from -1 to 1
  half_sine,  ///< sin(theta/(2 duty)) on the first `duty` of the period, else 0
  table,      ///< straight lines between rows
  orders,     ///< a sum of sines of several orders
};
/// sine sin(order theta) + cosine cos(order theta)
struct ForceWave {
  int order;
  double sine, cosine;
};
/// A row of a measured force.
struct ForceRow {
  double share;          ///< of the period; they rise
  double before, after;  ///< between which s jumps there
};

/// A main mass, 1, with friction, between stops, that may carry a loose mass eps between two walls:
///   x'' + 2h x' + k x + mu sgn x' = f s(nu tau + phase) + load + soft stops + F sgn z',
///   y'' = loose_load - F sgn z'/eps, z = y - x.
/// At z' = 0 friction on the housing holds both together up to a static level.
/// A soft stop pushes with max(0, kappa depth + 2 zeta sqrt(kappa) depth'), a soft wall both masses apart with max(0,
/// kappa depth + 2 zeta sqrt(kappa eps/(1 + eps)) depth'); one of infinite kappa is rigid.
/// Each stop may move by itself, by shake sin(nu tau + phase + shake_phase) about its place, if there is neither
/// friction nor a loose mass: it throws back, pushes and holds by place and velocity as seen from it. A start within
/// rounding of one is on it, and at rest on it with a velocity within rounding of its own.
struct MachineScene {
  double damping = 0, stiffness = 1, forcing = 0, frequency = 1, phase = 0, load = 0;
  ForceShape shape = ForceShape::sine;
  double duty = 0.5, rise = 0.25;            ///< of the shapes that have them: 0 < duty <= 1, 0 < rise <= 1/2
  std::vector<ForceRow> table{};             ///< of the shape that has one
  std::vector<ForceWave> waves{};            ///< of the shape that has orders
  double friction = 0, static_friction = 0;  ///< levels; the static one is no less than the other
  double lower = -no_stop, upper = no_stop;  ///< places of the stops; infinite: none
  double restitution_lower = 1, restitution_upper = 1;
  Law law_lower{}, law_upper{};
  double kappa_lower = no_stop, kappa_upper = no_stop;
  double zeta_lower = 0, zeta_upper = 0;
  double shake_lower = 0, shake_upper = 0;              ///< amplitudes; 0: it stands
  double shake_phase_lower = 0, shake_phase_upper = 0;  ///< by which they lead the force
  double loose_mass = 0;                                ///< eps; 0: none
  double wall_lower = -no_stop, wall_upper = no_stop;
  double wall_R_lower = 1, wall_R_upper = 1;
  Law wall_law_lower{}, wall_law_upper{};
  double wall_kappa_lower = no_stop, wall_kappa_upper = no_stop;
  double wall_zeta_lower = 0, wall_zeta_upper = 0;
  double loose_load = 0;
  double loose_friction = 0, loose_static = 0;  ///< F and its static level, no less; 0: none
  double x = 0, v = 0;                          ///< of the main mass at the start
  double z = 0, w = 0;                          ///< of the loose mass at the start, as seen from the main one
  double step = 0.5;     ///< the longest of a Taylor step, times the fastest rate: the terms left out are below 1e-37
  double still = 1e-26;  ///< a rebound with less of the fastest speed is the last one
  /// Lets each impact come late by so many parts of x, each release by as many of the forces, and moves each place at
  /// which the velocity falls to 0, but by a millionth of the way before at most: the effect of a coarser arithmetic.
  double rounding = 0;
};

/// What happens at an instant.
struct MachineEvent {
  enum class Kind : std::uint8_t {
    stop_impact,  ///< of the main mass on a rigid stop
    wall_impact,  ///< of the loose mass on a wall
    rest,         ///< the main mass begins to rest on a rigid stop
    rest_end,
    stick,  ///< friction begins to hold the main mass, away from rigid stops
    stick_end,
    reversal,  ///< the velocity of the main mass passes 0 under friction
    press,     ///< a wall begins to take the loose mass along
    release,
    hold,  ///< friction begins to take the loose mass along, away from the walls
    hold_end,
    touch,       ///< of a soft stop at its place
    separation,  ///< the force of a soft stop falls to 0
    renewal,     ///< it rises again, beyond the stop's place
    wall_touch,  ///< of a soft wall by the loose mass
    leave,       ///< the main mass comes back over the place of a soft stop that has no force
  };
  Kind kind;
  int side;                             ///< 1: the upper stop or wall, -1: the lower one, 0: none
  long double time;                     ///< tau
  long double before, after;            ///< z' of an impact on a wall, x' otherwise, as seen from the event's stop
  long double place;                    ///< x
  long double main_before, main_after;  ///< x'
  long double pull;  ///< x'' at the end of a slip; z'' with which the loose mass is pressed; 0 of others
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
struct MachineRun {
  std::vector<MachineEvent> events{};
  long double time = 0, x = 0, v = 0, z = 0, w = 0;  ///< at the end
  Range of_x{}, of_y{}, of_z{};
  /// The largest |x'|, in frames of moving stops too, or |z'| at the beginning or the end of a Taylor step.
  long double fastest = 0;
  /// Energy lost to h, in impacts (as the stop sees them) after the start, to friction of the main mass, and to that in
  /// the housing.
  long double damped = 0, struck = 0, rubbed = 0, rubbed_in_housing = 0;
  long double stored = 0;  ///< energy of both masses and the spring at the end, less that after an impact at the start
  /// How near the run was to another course: the least of the speed of a contact, the clearance of a near miss, and
  /// the margin by which a mass was held or let go, each as part of the largest since the last such event.
  long double closest = 1;
  std::size_t impacts = 0;
  bool finished = false;  ///< false: more impacts than allowed, or an endless change between modes
};

/// Simulates a scene by Taylor series in 113 bits. It shares nothing with the program: no closed form, no root finder,
/// no sum over chatter. Impacts are followed one by one until a rebound is still or takes less than 1e-27 of the
/// unit of time.
[[nodiscard]] MachineRun run_machine(const MachineScene& scene, double duration, std::size_t most_impacts);

}  // namespace clatter::hard
