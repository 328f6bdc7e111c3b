#pragma once

#include <functional>
#include <span>

#include "motion/state.hpp"
#include "observables/all.hpp"
#include "point/decided.hpp"
#include "point/problem.hpp"
#include "scene/required_effects.hpp"
#include "steady/observed_time.hpp"

namespace clatter::point {

using observables::no_value;

/// The end of an observed motion, from which the next point of a chain starts.
struct End : Start {
  double loose_place = 0.0, loose_velocity = 0.0;  ///< of a loose mass, if there is one: z and z'
};

/// The results of a point; values that are not observed, or of a failed point, are NaN or empty.
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
  End end{};
};

/// Memory that the points of one thread share.
struct ThreadScratch {
  observables::FourierScratch fourier{};
  Decisions decisions{};  ///< of doubtful motions
  /// Called now and then with the finished shares of the points at work, added up.
  std::function<void(double share)> progress{};

  ~ThreadScratch();
};

/// The effects that a point is run with: those that its scene requires; all of them on request, or for a general
/// method.
[[nodiscard]] Effects effects_of(const Problem& problem);

/// A point that waits to be run.
struct WorkItem {
  std::size_t chain = 0;     ///< of a run: points that start from the ends of each other, or a single one (`Share`)
  std::size_t position = 0;  ///< along it
  Problem problem;
  Effects effects{};
};

/// Runs points of one compiled set of effects, or one general method, with one dispatch for all. `take` gets
/// the results in their order.
void run_batch(std::span<const WorkItem> items, ThreadScratch& scratch,
               const std::function<void(const WorkItem&, PointResult&&)>& take);

/// Runs a single point.
[[nodiscard]] PointResult run_point(const Problem& problem, ThreadScratch& scratch);

/// Wall time of an evaluation of an arc, contact search included, with the compiled set of these effects, measured
/// for a short time on a scene of its own.
[[nodiscard]] double seconds_per_evaluation(const Effects& effects);

/// Wall time of a forcing period of a problem, measured for a short time on its first ones.
[[nodiscard]] double seconds_per_period(Problem problem, ThreadScratch& scratch);

}  // namespace clatter::point
