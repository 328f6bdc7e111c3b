#pragma once

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// Whether motion without events may come to a resonance between two points of its branch. It has no unknowns whose
/// curve would turn there, and a step could pass the whole peak at which it meets the stops. The tangents of the
/// amplitude at both points lead nowhere near the other one then.
[[nodiscard]] bool may_resonate_between(const OrbitEquations& equations, const Vector& one, const Vector& other);

}  // namespace clatter::branches
