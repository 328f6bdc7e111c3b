#pragma once

#include "branches/equations/equations.hpp"

namespace clatter::branches {

/// Zero in a resonant graze of one mass: the nth iterate of the motion's map has no term in the square root of the
/// distance from the graze (Simpson & Ghosh 2026), n = 1 ... 4.
[[nodiscard]] double resonance(const OrbitEquations& equations, const Vector& at, int n);

/// A motion over n periods, with its graze in the first of them alone.
[[nodiscard]] Orbit grazing_once_in(const FollowedScene& scene, const Orbit& orbit, std::size_t graze, int n);

}  // namespace clatter::branches
