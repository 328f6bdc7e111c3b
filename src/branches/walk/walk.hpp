#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "branches/equations/newton.hpp"

namespace clatter::branches {

/// A point of a solution curve, with its unit tangent.
struct CurvePoint {
  Vector at, tangent;
  double arclength = 0.0;
};

/// How a solution curve is followed.
struct WalkLimits {
  double tolerance = 1e-12;
  double largest_step = 0.02;
};

/// A function along the curve whose zero is a special point, found where it changes sign.
using TestFunction = std::function<double(const CurvePoint&)>;

/// Follows a solution curve by pseudo-arclength steps (Keller 1977): as long as Newton's method converges fast and the
/// tangent turns little they grow, else they shrink.
class Walk {
 public:
  Walk(const OrbitEquations& equations, CurvePoint start, const WalkLimits& limits)
      : equations_(equations), here_(std::move(start)), limits_(limits), step_(limits.largest_step / 8) {}

  [[nodiscard]] const CurvePoint& here() const { return here_; }

  /// The next point; nothing if no step, however short, leads on.
  [[nodiscard]] std::optional<CurvePoint> next();
  /// Goes on from a point that `next` gave.
  void move_to(CurvePoint point) { here_ = std::move(point); }

  /// Whether the step to a point that `next` gave passes another point: on the way back to its start a curve is closed.
  [[nodiscard]] bool passes(const CurvePoint& other, const CurvePoint& next) const;

  /// The point of the curve a distance s <= that of `next` after the present one, along its tangent.
  [[nodiscard]] std::optional<CurvePoint> after(double s) const;

  /// The zero of a test function between two points at distances `from` and `to` from the present one, by a bracketing
  /// method of high order (Alefeld, Potra and Shi 1995). If the curve can't be followed to it, the point of the
  /// narrowest bracket between points that can be reached, at which the test changes sign linearly. Nothing if its sign
  /// doesn't change.
  [[nodiscard]] std::optional<CurvePoint> zero(const TestFunction& test, double to, double from = 0.0) const;

 private:
  [[nodiscard]] std::optional<CurvePoint> past_corner(double step) const;
  [[nodiscard]] std::optional<CurvePoint> zero_between_reached(const TestFunction& test, double to, double from) const;

  const OrbitEquations& equations_;
  CurvePoint here_;
  WalkLimits limits_;
  double step_;
};

}  // namespace clatter::branches
