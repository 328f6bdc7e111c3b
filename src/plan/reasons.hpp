#pragma once

#include <string>
#include <vector>

#include "plan/bounds.hpp"
#include "point/problem.hpp"

namespace clatter::plan {

/// An effect, whether a scene calls for it, and why.
struct Reason {
  std::string effect;
  bool required = false;
  std::string why;  ///< e.g. "|x| <= 5.03 < 6 for all time: out of reach"
  Bounds saving{};  ///< share of the time, if it is left out; 0 if the compiled set of the scene has it all the same
};

/// Every effect of a scene: damping, forcing, resonance, load, lower stop, upper stop, dissipation, chatter and rest;
/// of one with a loose mass that in place of the last four.
[[nodiscard]] std::vector<Reason> reasons_of(const point::Problem& scene);

}  // namespace clatter::plan
