#pragma once

#include <optional>

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// The accuracy of Newton's method beside a singular point, where its steps shrink by a half each: the longest last
/// one.
inline constexpr double beside_singular = 1e-9;

/// The point of a branch in the plane normal to `direction` through `guess`, by Newton's method; nothing if it doesn't
/// converge to `tolerance`, in the equations' units.
[[nodiscard]] std::optional<Vector> corrected(const OrbitEquations& equations, Vector guess, const Vector& direction,
                                              double tolerance);

/// The solution of as many equations as unknowns near a guess; nothing if it doesn't converge.
[[nodiscard]] std::optional<Vector> solution(const OrbitEquations& equations, Vector guess, double tolerance);

/// The branch's unit tangent at a point, at an acute angle to `direction`; nothing where it is not unique.
[[nodiscard]] std::optional<Vector> tangent(const OrbitEquations& equations, const Vector& point,
                                            const Vector& direction);

}  // namespace clatter::branches
