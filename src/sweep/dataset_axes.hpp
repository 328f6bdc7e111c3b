#pragma once

#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Adds the sweep's dimensions and the coordinates along them.
void add_axes(const Sweep& sweep, results::Dataset& dataset);

/// Says of a variable in which frame it is given, by the attribute `frame`, if something is shaken.
void name_frame(const Sweep& sweep, observables::FrameOf frame, results::Variable& variable);

/// Names linked axes in the attribute `coordinates` of each variable over their dimension, so that readers take them
/// for coordinates (CF conventions, 5). Call it once all variables are added.
void name_linked_axes(const Sweep& sweep, results::Dataset& dataset);

/// Names of the sweep's dimensions.
[[nodiscard]] std::vector<std::string> axis_names(const Sweep& sweep);

}  // namespace clatter::sweep
