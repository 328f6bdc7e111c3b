#pragma once

#include <functional>
#include <memory>
#include <span>

#include "point/exact_motion.hpp"
#include "point/point.hpp"
#include "stepping/exact.hpp"

namespace clatter::point {

/// The exact method, compiled for a set of effects. That takes a good part of the whole build, so each file named
/// exact_points_* compiles a few sets.
template <Effects E>
class ExactPoints {
 public:
  using Integrator = stepping::Exact<double, E>;

  /// Runs points, and passes their results on in their order.
  static void run(std::span<const WorkItem> items, ThreadScratch& scratch,
                  const std::function<void(const WorkItem&, PointResult&&)>& take);

  /// The result of a motion that was found elsewhere, as far as the integrator has brought it.
  [[nodiscard]] static PointResult observe(const Problem& problem, ThreadScratch& scratch, const Integrator& integrator,
                                           const steady::ObservedTime& observed);

  /// The motion of a problem between the stops in reach.
  [[nodiscard]] static std::unique_ptr<ExactMotion> motion(const Problem& problem, const Stops& in_reach);

  /// Wall time of an evaluation of an arc, contact search included.
  [[nodiscard]] static double seconds_per_evaluation();
};

}  // namespace clatter::point
