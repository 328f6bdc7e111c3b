#pragma once

#include <array>

#include "point/problem.hpp"

namespace clatter::sweep {

/// How the damping of a machine is given.
enum class DampingGiven { coefficient, ratio, quality };

/// A mass, its spring, damper and force in SI: m X'' + c X' + K X = F sin(2 pi frequency t + phase) + L.
struct Machine {
  double mass = 1.0;                                       ///< m, kg, > 0
  double stiffness = 0.0;                                  ///< K, N/m, any finite
  double damping = 0.0;                                    ///< c, N s/m; or c/(2 (K m)^(1/2)), or (K m)^(1/2)/c
  DampingGiven damping_given = DampingGiven::coefficient;  ///< which of these
  double force = 0.0;                                      ///< F, N, any finite
  double frequency = 0.0;                                  ///< Hz, > 0 if there is a force, or stops or base shake
  double load = 0.0;                                       ///< L, N, any finite
  /// Of the lower and the upper soft stop: whether the damping of the problem's stops is in N s/m, in place of a ratio.
  std::array<bool, 2> stop_damping_in_si{};
};

/// The units that a machine is computed in: its time is that of the natural frequency (of the force without a spring, a
/// second without either).
[[nodiscard]] Units units_of(const Machine& machine);

/// The oscillator of a machine in these units: its stiffness is 1, 0 or -1.
[[nodiscard]] Oscillator oscillator_of(const Machine& machine, const Units& units);

/// Makes the numbers of a problem, which are in SI, those that it is computed with, and its oscillator that of a
/// machine: its stiffness is 1, 0 or -1.
void to_computed_units(point::Problem& problem, Machine machine);

/// Makes the numbers of a problem, which are those of the user, the ones that it is computed with: its stiffness is 1,
/// 0 or -1. With k = 1 they are the same.
void to_computed_units(point::Problem& problem);

}  // namespace clatter::sweep
