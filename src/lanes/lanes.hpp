#pragma once

#include <cstddef>
#include <cstdint>

namespace clatter {

/// A number for each lane.
struct alignas(64) Row {
  static constexpr std::size_t width = 16;
  double lane[width];
};

/// One bit for each lane.
using LaneSet = std::uint32_t;

/// Scenes that run side by side, a lane each: what their kernel reads and writes, the same for every instruction set.
///
/// Each lane counts its time in steps of a length that an enclosure usually proves free of contact at once. So v and w
/// are velocities times that length and a is the acceleration times its square; displacements are seen from the load's
/// equilibrium. The motion is the steady response to the force plus a free part (p, w).
struct Lanes {
  static constexpr std::size_t most_harmonics = 8;  ///< that are summed in lanes

  // of the oscillator
  Row free_pp, free_pw, free_wp, free_ww;  ///< free motion over a step: p' = pp p + pw w, w' = ww w - wp p
  Row turn_sine, turn_cosine;              ///< of the forcing phase in a step
  Row in_phase, quadrature;                ///< P and Q of the response
  Row angle, rotation, decay, damping;     ///< nu, lambda, h and 2 h times the step
  Row skew, slowness;                      ///< h/lambda; one over the rotation
  Row push, stiffness;                     ///< f nu times the step cubed; the step squared
  Row rate;                                ///< one over the step
  Row inverse_angle;                       ///< one over the angle
  Row amplitude, span;                     ///< of the response; the step
  // of the stops
  Row lower, upper, keep_lower, keep_upper;  ///< places and restitution
  // of the enclosure
  Row bound, bound_forced;  ///< the error of its middle coefficient is bound (|p| + |w| rate) + bound_forced
  Row rounding;             ///< of places, the part that doesn't depend on the free motion
  // of the sections
  Row period, start_sine, start_cosine;
  // where the lanes are
  Row p, w, sine, cosine, y, v, a;
  Row left;     ///< time to the next section
  Row to_next;  ///< from that to the one after it, by the lane's clock
  Row longer;   ///< by what part sine and cosine are to be shortened at the next section
  Row impacts;  ///< met so far
  Row trace;    ///< stops met since the last section
  // what a visit reports
  Row section_y, section_v;            ///< at the section that was passed
  Row section_trace, section_impacts;  ///< trace and impacts up to it
  LaneSet arrived;                     ///< lanes that have passed a section and report it
  LaneSet stuck;                       ///< lanes that the kernel cannot take on from where they are
  // of what is observed, where it is
  Row quiet;                         ///< sections that are passed without a report before the next one
  Row ends;                          ///< 1: the next section ends the observed time
  Row clips;                         ///< 1: and the flight across it isn't taken, since it leads beyond
  Row bound_v, bound_forced_v;       ///< as bound and bound_forced, of the velocity
  Row y_low, y_high, v_low, v_high;  ///< least and greatest so far
  /// The beginning of the flight in which an extremum was found, and its length.
  struct Reference {
    Row p, w, sine, cosine, length;
  };
  Reference reference_y[2], reference_v[2];  ///< [least, greatest]
  Row forced_size;                           ///< what a unit of phase changes the displacement and velocity by, at most
  Row count[2], before[2], after[2];         ///< [stop]: impacts, and the velocities of the first one
  Row first_before;                          ///< velocity before the first impact of all
  Row jump_real[most_harmonics + 1],
      jump_imaginary[most_harmonics + 1];  ///< [k]: sums of the velocity's jumps times e^{-ik nu tau}
  bool extrema;                            ///< whether y and v are searched for them
  bool counts;                             ///< whether impacts are counted, and the first on each stop noted
  std::size_t harmonics;                   ///< highest k that is summed; 0: none
  // what it took
  double proved, refined;  ///< lanes times steps that were to be proved, and times contacts that were looked for
};

}  // namespace clatter
