#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace clatter::lanes {

/// A number for each lane.
struct alignas(64) LaneArray {
  static constexpr std::size_t width = 16;
  double lane[width];
};

/// One bit for each lane.
using LaneMask = std::uint32_t;

/// The state of scenes that run side by side, a lane each: all that the step functions read and write, the same for
/// every instruction set.
///
/// Displacements count from the load's equilibrium. The motion is the steady response to the force plus a free part.
/// Each lane is proved free of contact in steps of a length that an enclosure usually proves at once. Sections are the
/// stroboscopic sections of `motion::State`.
struct BlockState {
  static constexpr std::size_t most_harmonics = 8;  ///< the highest harmonic that is summed in lanes

  // of the oscillator
  LaneArray h, twice_h, f, nu, root, inverse_root;  ///< h, 2 h, f, nu, lambda, 1/lambda
  LaneArray in_phase, quadrature, amplitude;        ///< of the response
  // of a step
  LaneArray step, inverse_step;
  LaneArray free_a, free_b, free_c;            ///< its propagator
  LaneArray turn_sine, turn_cosine_minus_one;  ///< its turn of the forcing phase
  LaneArray bound, bound_forced;               ///< the error of its enclosure is bound (|x| + |v|) + bound_forced
  LaneArray bound_v, bound_forced_v;           ///< the same for the enclosure of the velocity
  LaneArray rounding;                          ///< of displacements: the part that doesn't depend on the free motion
  // of the stops
  LaneArray lower, upper;  ///< between which the motion is free of contact
  LaneArray stop_lower, stop_upper, restitution_lower, restitution_upper;
  // of the sections
  LaneArray period, start_sine, start_cosine;
  // present state
  LaneArray free_x, free_v, sine, cosine, y, v, a;
  LaneArray time_to_section;  ///< time to the next section that is reported
  LaneArray to_next;          ///< time from that section to the next that is reported, by the lane's clock
  LaneArray excess;           ///< the relative excess of sine and cosine, taken off at the next section
  LaneArray impacts;          ///< number of impacts so far
  LaneArray itinerary;        ///< stops met since the last section that was reported
  // reports of a step function
  LaneArray section_y, section_v;                ///< displacement and velocity at the section that was passed
  LaneArray section_itinerary, section_impacts;  ///< itinerary and impacts up to it
  LaneMask arrived;                              ///< lanes that have passed a section
  LaneMask to_scalar;                            ///< lanes that the scalar loop has to advance from their state
  // observation
  LaneArray ends_here;   ///< 1: the next section ends the observed time
  LaneArray stop_short;  ///< 1: stop before the section, since the flight across it would overshoot; else 0
  LaneArray y_low, y_high, v_low, v_high;  ///< least and greatest so far
  /// The beginning of the flight in which an extremum was found, and its length.
  struct Reference {
    LaneArray free_x, free_v, sine, cosine, length;
  };
  Reference reference_y[2], reference_v[2];  ///< [least, greatest]
  LaneArray forced_size;                     ///< bound of the change of displacement and velocity per unit of phase
  LaneArray count[2], before[2], after[2];   ///< [stop]: impacts, and the velocities of the first one
  LaneArray fastest[2];                      ///< [stop]: speed of the fastest impact
  LaneArray first_before;                    ///< velocity before the first impact on either stop
  LaneArray jump_real[most_harmonics + 1],
      jump_imaginary[most_harmonics + 1];  ///< [k]: sums of the velocity's jumps times e^{-ik nu tau}
  bool extrema;                            ///< whether those of y and v are observed
  bool counts;                             ///< whether impacts are counted, and the first on each stop noted
  std::size_t harmonics;                   ///< highest k that is summed; 0: none
  // work
  int most_contacts = 1;   ///< times that a call takes lanes to their next contact, unless a lane has to report
  double proved, refined;  ///< lanes times steps to be proved, and lanes times contacts to be refined
  /// Of lanes without a spring, or with an unstable one.
  struct Unsprung {
    LaneArray k, pull;             ///< stiffness, 0 or -1; the load if there is no spring, else 0
    LaneArray root_square;         ///< k - h^2: -lambda^2
    LaneArray free_kb;             ///< k times the propagator's b over a step
    LaneArray pulled_x, pulled_v;  ///< where the load takes a mass at rest in a step
    LaneArray reach_x, reach_v;    ///< over a step x and v stay below reach_x |x| + reach_v |v| + reach_of_pull
    LaneArray reach_of_pull;
  } unsprung;
  /// Of lanes with soft stops, which take the mass from one oscillator to another. The constants of the present one
  /// stand in the rows above; displacements count from its equilibrium, and lower and upper bound y + relaxation v.
  struct Cushioned {
    static constexpr std::size_t rows = 25;
    LaneArray phase;                ///< 0 between the stops; -1, 1: in contact with the lower, the upper one; -2, 2:
                                    ///< beyond its position without contact
    LaneArray k, natural, free_kb;  ///< stiffness, its root, and k times the propagator's b over a step
    LaneArray relaxation;           ///< of the stop in contact, 2 h_s/kappa; else 0
    LaneArray rounding_of_free;     ///< rounding of y + relaxation v, per size of the free motion
    LaneArray shift;                ///< its equilibrium less that of motion between the stops
    LaneArray shrinks;              ///< 2 h_s in contact, else 0: the rate at which the stop shrinks areas of states
    LaneArray of_phase[3][rows];    ///< [between the stops, in contact with the lower, the upper one]
    LaneArray soft[2];              ///< [stop]: 1 if it is soft
    LaneArray relaxation_of[2];     ///< [stop]
    LaneArray log_area;             ///< logarithm of the factor by which soft stops have shrunk areas
    LaneArray section_log_area;     ///< the same up to the section that was passed
  } cushioned;
};

/// The rows that depend on the phase of a motion between soft stops.
[[nodiscard]] inline std::array<LaneArray*, BlockState::Cushioned::rows> rows_of_phase(BlockState& b) {
  BlockState::Cushioned& c = b.cushioned;
  return {&b.h,
          &b.twice_h,
          &b.root,
          &b.inverse_root,
          &b.in_phase,
          &b.quadrature,
          &b.step,
          &b.inverse_step,
          &b.free_a,
          &b.free_b,
          &b.free_c,
          &b.turn_sine,
          &b.turn_cosine_minus_one,
          &b.bound,
          &b.bound_forced,
          &b.rounding,
          &b.lower,
          &b.upper,
          &c.k,
          &c.natural,
          &c.free_kb,
          &c.relaxation,
          &c.rounding_of_free,
          &c.shift,
          &c.shrinks};
}

}  // namespace clatter::lanes
