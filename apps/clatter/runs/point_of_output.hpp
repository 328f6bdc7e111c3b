#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/given_scene.hpp"
#include "scene/parameter.hpp"
#include "tables/point_filter.hpp"

namespace clatter::app {

/// The steady motion at a point of an output, from which a branch can start.
struct PointOfOutput {
  std::string name;               ///< "nu = 1.2, R = 0.7", "point 57, branch 2, nu = 1.198"
  GivenScene scene;               ///< there; its start is the motion's state at forcing phase 0, in the user's units
  std::vector<Parameter> varied;  ///< of the scene, by the output: axes, or what its branches run along
  std::int64_t periods = 1;       ///< of the force, after which the motion repeats
};

/// The point that --where chooses: of a sweep by the values of its axes, of branches by that of their parameter, or by
/// the numbers of a branch and of a point. A point of a sweep is run anew as `clatter run` runs it, so that any output
/// will do; a point of a branch is stored with its state. Throws UsageError if there is no such point, or several, or
/// no periodic motion there, and IoError if the file can't be read.
[[nodiscard]] PointOfOutput point_of_output(const std::string& path, const std::vector<Condition>& where);

}  // namespace clatter::app
