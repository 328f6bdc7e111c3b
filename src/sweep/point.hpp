#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "dynamics/scene.hpp"
#include "dynamics/state.hpp"
#include "observables/fourier_transform.hpp"
#include "observables/harmonics.hpp"
#include "observables/impacts.hpp"

namespace clatter {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Everything that a point gives; what is not observed, or of a failed point, is NaN or empty.
struct PointResult {
  Status status = Status::unresolved;
  double impacts = 0.0;  ///< simulated, settling included
  double periods = 0.0;  ///< forcing periods simulated, settling included
  double x_min = no_value, x_max = no_value, v_min = no_value, v_max = no_value;
  double base_frequency = no_value;
  Spectrum x_spectrum{}, v_spectrum{};                  ///< shape [harmonic]
  double impacts_per_period[2] = {no_value, no_value};  ///< [stop]
  double v_before[2] = {no_value, no_value}, v_after[2] = {no_value, no_value}, rest_fraction[2] = {no_value, no_value};
  std::vector<Impact> log{};
  std::vector<double> tau{}, x{}, v{};  ///< shape [sample]
  double period = no_value, period_ratio = no_value, eigenfrequency = no_value, velocity_ratio = no_value;
  Start end{};  ///< where the motion was left, for the next point of a branch
};

/// What the points of one thread share.
struct Workshop {
  const FourierTransform* transform = nullptr;  ///< of harmonics_samples samples; null where none are observed
  std::unique_ptr<FourierTransform::Workspace, void (*)(FourierTransform::Workspace*)> workspace{nullptr, nullptr};
};

/// Runs one point: settles, observes, and says where the motion was left.
[[nodiscard]] PointResult run_point(const Scene& scene, Workshop& workshop);

}  // namespace clatter
