#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "branches/equations/followed_scene.hpp"
#include "branches/symmetric_motion.hpp"
#include "scene/response.hpp"

namespace clatter::branches {

/// Symmetric motion of a loose mass between walls at -s and s, with one impact on each and period, in closed form
/// (Masri and Caughey 1966): alpha u - s and gamma u are components of the response, u the relative speed before an
/// impact.
struct HousingMotion {
  explicit HousingMotion(const FollowedScene& scene) : oscillator(oscillator_in_frame(scene)), wall(scene.loose.upper) {
    const double nu = oscillator.frequency, R = scene.loose.restitution_lower.R, eps = scene.loose.ratio;
    kick = eps * (1 + R) / (1 + eps);
    slip = (1 - R + kick) / 2;  // the main mass has -slip u before an impact on the upper wall, as the loose one flies
    half = std::numbers::pi / (2 * nu) * (1 - slip);  // half the way from wall to wall over u
    const auto [xx, xv, vx, vv] = free_flow(oscillator.damping, oscillator.stiffness, std::numbers::pi / nu);
    const double D = (1 + xx) * (1 + vv) - xv * vx;
    // (1 + flow)(p, q) = -flow (0, kick u), the main mass less the response at the impact on the upper wall
    const double p = -kick * xv / D, q = -kick * (vv * (1 + xx) - vx * xv) / D;
    alpha = half - p, gamma = (-slip - q) / nu;
    square = alpha * alpha + gamma * gamma;
    amplitude = steady_response(oscillator).amplitude;
    discriminant = alpha * alpha * wall * wall - square * (wall * wall - amplitude * amplitude);
  }

  /// Of the impacts; sign -1: the slower of the two motions.
  [[nodiscard]] double speed(int sign) const { return (alpha * wall + sign * std::sqrt(discriminant)) / square; }
  /// Displacement of the main mass at the impact on the upper wall, and its velocity before it.
  [[nodiscard]] double place(double u) const { return half * u - wall; }
  [[nodiscard]] double velocity(double u) const { return -slip * u; }
  /// Amplitude of the response at which both motions become one.
  [[nodiscard]] double fold() const { return wall * std::abs(gamma) / std::sqrt(square); }

  Oscillator oscillator;
  double wall, kick, slip, half, alpha, gamma, square, amplitude, discriminant;
};

}  // namespace clatter::branches
