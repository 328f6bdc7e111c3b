#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "model/required_effects.hpp"
#include "motion/state.hpp"
#include "observables/fourier_transform.hpp"
#include "observables/harmonics.hpp"
#include "observables/impacts.hpp"
#include "point/problem.hpp"
#include "steady/observed_time.hpp"

namespace clatter::point {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Everything that a point gives; what is not observed, or of a failed point, is NaN or empty.
struct PointResult {
  steady::Status status = steady::Status::unresolved;
  steady::FoundBy found_by = steady::FoundBy::nothing;
  bool in_lanes = false;  ///< observed in SIMD lanes
  double impacts = 0.0;   ///< simulated, settling included
  double periods = 0.0;   ///< forcing periods simulated, settling included
  /// Of arcs by the scalar kernel (of the equation by general methods), settling and observables included.
  double evaluations = 0.0;
  double settling_estimate = no_value;  ///< forcing periods until the motion is within the tolerance of the steady one
  double observed_turns = no_value;     ///< forcing periods observed
  double x_min = no_value, x_max = no_value, v_min = no_value, v_max = no_value;
  double base_frequency = no_value;
  observables::Spectrum x_spectrum{}, v_spectrum{};     ///< shape [harmonic]
  double impacts_per_period[2] = {no_value, no_value};  ///< [stop]
  double v_before[2] = {no_value, no_value}, v_after[2] = {no_value, no_value}, rest_fraction[2] = {no_value, no_value};
  std::vector<motion::Impact> log{};
  std::vector<motion::Rest> rests{};
  std::vector<double> tau{}, x{}, v{};  ///< shape [sample]
  double period = no_value, period_ratio = no_value, eigenfrequency = no_value, velocity_ratio = no_value;
  double multiplier_re[2] = {no_value, no_value}, multiplier_im[2] = {no_value, no_value};  ///< the larger first
  double lyapunov = no_value;
  Start end{};  ///< where the motion was left, for the next point of a branch
};

/// What the points of one thread share.
struct ThreadScratch {
  const observables::FourierTransform* transform =
      nullptr;  ///< of harmonics_samples samples; null where none are observed
  std::unique_ptr<observables::FourierTransform::Workspace, void (*)(observables::FourierTransform::Workspace*)>
      workspace{nullptr, nullptr};
  /// Hears now and then what share of all that they may come to the points at work have done, added up.
  std::function<void(double share)> progress{};
};

/// The effects that a point is run with: what its scene requires; all where that is asked for, or the method is a
/// general one.
[[nodiscard]] Effects effects_of(const Problem& scene);

/// A point on its way to a kernel.
struct WorkItem {
  std::size_t local_index = 0;  ///< where its results go (`Share`)
  Problem scene;
  Effects effects;
};

/// Runs points of one and the same kernel or general method, with one dispatch: each settles, observes, and says where
/// the motion was left; `take` gets the results in their order.
void run_batch(std::span<const WorkItem> items, ThreadScratch& scratch,
               const std::function<void(const WorkItem&, PointResult&&)>& take);

/// Runs a single point.
[[nodiscard]] PointResult run_point(const Problem& scene, ThreadScratch& scratch);

/// Wall time of an evaluation of an arc, contact search included, in the kernel of these effects: a short measurement
/// on a scene of its own.
[[nodiscard]] double seconds_per_evaluation(const Effects& effects);

/// Wall time of a forcing period of a scene: a short measurement on its first ones.
[[nodiscard]] double seconds_per_period(Problem scene, ThreadScratch& scratch);

}  // namespace clatter::point
