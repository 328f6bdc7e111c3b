#pragma once

#include <cstddef>
#include <optional>

#include "branches/equations.hpp"

namespace clatter::branches {

/// Why a solution of the equations is no motion between stops.
struct Violation {
  enum class Kind : std::uint8_t {
    passes_through,  ///< a flight meets a stop before its end
    pulls            ///< an impact's velocity points away from its stop
  };
  Kind kind = Kind::passes_through;
  std::size_t impact = 0;  ///< that the flight began with; or that pulls
  OrbitImpact turning{};   ///< passes_through: the turning point beyond the stop, as an impact without speed
};

/// The first violation of an orbit, by the proof of first contact on each of its flights; nothing: it is a motion. The
/// impact `grazing` may be without speed.
[[nodiscard]] std::optional<Violation> violation(const ShakenScene& scene, const Orbit& orbit,
                                                 std::optional<std::size_t> grazing = {});
/// Of a point of a branch or a curve.
[[nodiscard]] inline std::optional<Violation> violation(const OrbitEquations& equations, const Vector& point) {
  return violation(equations.scene_at(point), equations.orbit_at(point), equations.grazing());
}

}  // namespace clatter::branches
