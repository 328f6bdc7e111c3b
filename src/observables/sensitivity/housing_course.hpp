#pragma once

#include <vector>

#include "motion/relative_arc.hpp"
#include "motion/state.hpp"

namespace clatter::observables {

/// A part of an observed time with a loose mass, as it was run: a flight of that, up to an impact on a wall or a
/// section; or a time in which a wall presses it, up to its release or a section.
struct HousingStretch {
  motion::Motion<double> start{};         ///< of the main mass
  double anchor = 0.0;                    ///< the position that its offset counts from
  double begin = 0.0;                     ///< tau since observation began
  double length = 0.0;                    ///< tau
  motion::RelativeStart<double> loose{};  ///< of a flight
  Side held = Side::none;                 ///< the wall that presses it
  Side struck = Side::none;               ///< the wall on which the impact at the end is
  bool comes_to_rest = false;             ///< on that wall, at the end
};

/// An observed time, stretch by stretch.
using HousingCourse = std::vector<HousingStretch>;

}  // namespace clatter::observables
