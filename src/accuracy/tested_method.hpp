#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lanes/instruction_set.hpp"
#include "point/problem.hpp"

namespace clatter::accuracy {

/// The method that a row tests.
enum class TestedMethod : std::uint8_t {
  exact,              ///< the exact integrator, over the horizon
  dopri5,             ///< setting: tolerance
  moreau,             ///< setting: step, in forcing periods
  harmonics_exact,    ///< harmonics from the arcs
  harmonics_fft,      ///< setting: samples
  steady,             ///< setting: tolerance of the repeat; steady search by all ways
  steady_repetition,  ///< setting: tolerance of the repeat; steady search by repetition alone
};

/// Names in the order of TestedMethod.
inline constexpr std::array<std::string_view, 7> method_names{
    "exact", "dopri5", "moreau", "harmonics_exact", "harmonics_fft", "steady", "steady_repetition"};

/// A row before it is run.
struct Trial {
  TestedMethod method = TestedMethod::exact;
  double setting = 0.0;  ///< NaN if there is none
  lanes::InstructionSet arch =
      lanes::InstructionSet::scalar;  ///< the exact method runs in the lanes of this set; scalar: in the scalar loop
};

/// All trials: exact; dopri5 at tolerances 1e-3 ... 1e-13; Moreau's time stepping at steps of 1e-1 ... 1e-5 periods;
/// harmonics, exact and of 2^4 ... 2^20 samples; in steady mode, the steady search at tolerances 1e-3 ... 1e-14. With
/// an instruction set other than scalar also exact and the steady search at 1e-12 in its lanes.
[[nodiscard]] std::vector<Trial> trials_of(steady::Mode mode, lanes::InstructionSet arch);

}  // namespace clatter::accuracy
