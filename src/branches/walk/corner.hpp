#pragma once

#include <cstddef>
#include <optional>

#include "branches/walk/walk.hpp"

namespace clatter::branches {

/// An impact whose speed comes to a corner of its law of restitution, at which the curve of motions has one, too.
struct Corner {
  std::size_t event = 0;       ///< its number
  double share = 0;            ///< of the way to the corner
  int heading = 0;             ///< of the speed over that of the corner: up or down
  double here = 0, there = 0;  ///< the speed of the corner at both ends of the way
};

/// The first corner on the way from a point of a curve to another one; nothing if there is none.
[[nodiscard]] std::optional<Corner> corner_between(const OrbitEquations& equations, const Vector& here,
                                                   const Vector& there);

/// The point of the curve just beyond a corner on the way to `there`, at which the impact is a little faster or slower
/// than the corner, with the tangent that leads on; nothing if there is none near.
[[nodiscard]] std::optional<CurvePoint> beyond_corner(const OrbitEquations& equations, const CurvePoint& here,
                                                      const Vector& there, const Corner& corner, double tolerance);

}  // namespace clatter::branches
