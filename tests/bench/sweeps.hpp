#pragma once

#include <cstddef>
#include <vector>

#include "sweep/run.hpp"
#include "sweep/sweep.hpp"

namespace clatter::bench {

/// n values from a to b in equal steps, both included.
[[nodiscard]] std::vector<double> linspace(double a, double b, std::size_t n);

/// The oscillator of the paper's figures, f = -1, h = 0.1, R = 0.7, from rest between stops at -|xs| and |xs|, over
/// frequencies 0.5 ... 1.5. Extrema are observed from the start, for `periods` forcing periods on average: for the same
/// time at every frequency, periods * 2 pi.
[[nodiscard]] sweep::Sweep transients(double xs, std::size_t points, double periods);

/// Those of Fig. 23 at frequencies 0.88 ... 1.11 alone, at which the steady response by itself is larger than the gap,
/// so that impacts never end.
[[nodiscard]] sweep::Sweep transients_that_keep_hitting(std::size_t points, double periods);

inline constexpr double xs_18 = -0.5;  ///< of Fig. 18: two impacts in a forcing period
inline constexpr double xs_23 = -3.0;  ///< of Fig. 23: impacts at resonance only, grazing and chaos beside it

/// The map of the same oscillator over frequencies 0.5 ... 1.5 and stops 0.2 ... 4, n of each: extrema, harmonics 0 ...
/// 3 from the arcs and the period of the steady motion, which is sought for at most 500 forcing periods.
[[nodiscard]] sweep::Sweep map(std::size_t n);

/// The same over stops 8 ... 12, which no motion reaches.
[[nodiscard]] sweep::Sweep map_out_of_reach(std::size_t n);

/// The work of a run, all points together.
struct Work {
  double impacts = 0.0, periods = 0.0;
};
[[nodiscard]] Work work_of(const sweep::RunResult& result);

}  // namespace clatter::bench
