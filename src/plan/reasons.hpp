#pragma once

#include <string>
#include <vector>

#include "point/problem.hpp"

namespace clatter::plan {

/// Shares of the time that leaving an effect out saves.
struct Saving {
  double least = 0.0, most = 0.0;

  friend bool operator==(const Saving&, const Saving&) = default;
};

/// An effect, whether a scene calls for it, and why.
struct Reason {
  std::string effect;
  bool required = false;
  std::string why;  ///< e.g. "|x| <= 5.03 < 6 for all time: out of reach"
  Saving saving{};  ///< if it is left out; 0 if the compiled set of the scene has it all the same
};

/// Every effect of a scene: damping, forcing, resonance, load, lower stop, upper stop, dissipation, chatter and rest.
[[nodiscard]] std::vector<Reason> reasons_of(const point::Problem& scene);

}  // namespace clatter::plan
