#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "branches/equations/followed_scene.hpp"
#include "scene/response.hpp"

namespace clatter::branches {

/// Free motion over a time by exponentials or by a decaying rotation, not near h^2 = k: [x by x, x by v, v by x, v by
/// v].
inline std::array<double, 4> free_flow(double h, double k, double time) {
  if (h == 0 && k == 0) return {1, time, 0, 1};
  const double root = std::sqrt(std::abs(h * h - k)), decay = std::exp(-h * time);
  const bool rotates = h * h < k;
  const double c = rotates ? std::cos(root * time) : std::cosh(root * time),
               s = (rotates ? std::sin(root * time) : std::sinh(root * time)) / root;
  return {decay * (c + h * s), decay * s, -k * decay * s, decay * (c - h * s)};
}

/// Symmetric motion with one impact on each stop and period (Masri and Caughey 1966): alpha u - g and gamma u are
/// components of the response at an impact of speed u.
struct SymmetricMotion {
  explicit SymmetricMotion(const FollowedScene& scene)
      : oscillator(oscillator_in_frame(scene)), gap(scene.stops.upper), R(scene.stops.restitution_upper.R) {
    const double nu = oscillator.frequency;
    flow = free_flow(oscillator.damping, oscillator.stiffness, std::numbers::pi / nu);
    const double D = 1 + flow[0] + flow[3] + flow[0] * flow[3] - flow[1] * flow[2];
    alpha = (1 + R) * flow[1] / D, gamma = ((1 + R) * (1 + flow[0]) / D - R) / nu;
    square = alpha * alpha + gamma * gamma;
    const double A = steady_response(oscillator).amplitude;
    discriminant = alpha * alpha * gap * gap - square * (gap * gap - A * A);
  }

  /// Of the impacts; sign -1: the slower of the two motions.
  [[nodiscard]] double speed(int sign) const { return (alpha * gap + sign * std::sqrt(discriminant)) / square; }

  /// Of the force at the impact of that speed on the upper stop.
  [[nodiscard]] double phase(double speed) const {
    const auto& [xx, xv, vx, vv] = flow;
    const double nu = oscillator.frequency, D = 1 + xx + vv + xx * vv - xv * vx;
    // (1 + flow) r = flow (-g, R u) - (g, u), the response r at the impact on the lower stop
    const double p = -xx * gap + xv * R * speed - gap, q = -vx * gap + vv * R * speed - speed;
    const double x = ((1 + vv) * p - xv * q) / D, v = (-vx * p + (1 + xx) * q) / D;
    const Response<double> response = steady_response(oscillator);
    const double P = response.in_phase, Q = response.quadrature;
    return std::atan2(P * x - Q * v / nu, Q * x + P * v / nu) + std::numbers::pi;
  }

  /// Of half a period's map at an impact of that speed, at a phase of the force on the upper stop.
  [[nodiscard]] double trace(double speed, double phase) const {
    const double h = oscillator.damping, force = oscillator.forcing * std::sin(phase) - oscillator.stiffness * gap;
    const double before = force - 2 * h * speed, after = force + 2 * h * R * speed,
                 corner = (R * before + after) / speed;
    return flow[0] * R - flow[1] * corner + flow[3] * R;
  }

  Oscillator oscillator;
  double gap, R;
  std::array<double, 4> flow{};
  double alpha = 0, gamma = 0, square = 0;
  double discriminant = 0;  ///< both motions become one, in a fold, where it is 0
};

}  // namespace clatter::branches
