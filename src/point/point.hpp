#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "model/required_effects.hpp"
#include "motion/state.hpp"
#include "observables/all.hpp"
#include "point/problem.hpp"
#include "steady/observed_time.hpp"

namespace clatter::point {

using observables::no_value;

/// Everything that a point gives; what is not observed, or of a failed point, is NaN or empty.
struct PointResult : observables::All::Values {
  steady::Status status = steady::Status::unresolved;
  steady::FoundBy found_by = steady::FoundBy::nothing;
  bool in_lanes = false;  ///< observed in SIMD lanes
  double impacts = 0.0;   ///< simulated, settling included
  double periods = 0.0;   ///< forcing periods simulated, settling included
  /// Of arcs by the scalar loop (of the equation by general methods), settling and observables included.
  double evaluations = 0.0;
  double settling_estimate = no_value;  ///< forcing periods until the motion is within the tolerance of the steady one
  double observed_turns = no_value;     ///< forcing periods observed
  Start end{};                          ///< where the motion was left, for the next point of a branch
};

/// What the points of one thread share.
struct ThreadScratch {
  observables::FourierScratch fourier{};
  /// Hears now and then what share of all that they may come to the points at work have done, added up.
  std::function<void(double share)> progress{};
};

/// The effects that a point is run with: what its scene requires; all where that is asked for, or the method is a
/// general one.
[[nodiscard]] Effects effects_of(const Problem& scene);

/// A point that waits to be run.
struct WorkItem {
  std::size_t local_index = 0;  ///< where its results go (`Share`)
  Problem scene;
  Effects effects;
};

/// Runs points of one compiled set of effects, or one general method, with one dispatch: each settles, observes, and
/// says where the motion was left; `take` gets the results in their order.
void run_batch(std::span<const WorkItem> items, ThreadScratch& scratch,
               const std::function<void(const WorkItem&, PointResult&&)>& take);

/// Runs a single point.
[[nodiscard]] PointResult run_point(const Problem& scene, ThreadScratch& scratch);

/// Wall time of an evaluation of an arc, contact search included, with the compiled set of these effects: a short
/// measurement on a scene of its own.
[[nodiscard]] double seconds_per_evaluation(const Effects& effects);

/// Wall time of a forcing period of a scene: a short measurement on its first ones.
[[nodiscard]] double seconds_per_period(Problem scene, ThreadScratch& scratch);

}  // namespace clatter::point
