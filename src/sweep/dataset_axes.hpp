#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// Adds the sweep's dimensions and the coordinates along them.
void add_axes(const Sweep& sweep, results::Dataset& dataset);

/// Says of a variable in which frame it is given, by the attribute `frame`, if something is shaken.
void name_frame(const Sweep& sweep, observables::FrameOf frame, results::Variable& variable);

/// Says of a variable which key of [observe] asks for it, by the attribute `observable`.
void name_observable(std::string_view key, results::Variable& variable);

/// Says how pictures name each variable, by the attributes `label` and `symbol`, and the constants of the scene, by the
/// root attribute `scene_names`; `on_walls`: impacts are those of a loose mass.
void add_drawn_names(bool is_si, results::Dataset& dataset, bool has_loose_mass, bool on_walls);

/// Names linked axes in the attribute `coordinates` of each variable over their dimension, so that readers take them
/// for coordinates (CF conventions, 5). Call it once all variables are added.
void name_linked_axes(const Sweep& sweep, results::Dataset& dataset);

/// Names the axes whose values are a sample of a range in the root attribute `sampled_axes`, so that readers take
/// quantiles over them, and draw no line from value to value.
void name_samples(const Sweep& sweep, results::Dataset& dataset);

/// Names of the sweep's dimensions.
[[nodiscard]] std::vector<std::string> axis_names(const Sweep& sweep);

}  // namespace clatter::sweep
