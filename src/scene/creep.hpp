#pragma once

#include <optional>

#include "math/number.hpp"
#include "scene/scene.hpp"

namespace clatter {
inline namespace scene {

/// Where a mass goes that is pulled towards the places at which dry friction holds it against the largest force: its
/// edge of that band.
struct BandEdge {
  Side side = Side::none;  ///< of the band
  double x = 0.0;
};

/// The edge that motion from displacement x and velocity v at a forcing phase is proved to creep to, ever more slowly:
/// each time the force is greatest the mass slips a little towards it, by a share of the way that is left, and never
/// beyond (eq. 77). Nothing if that isn't proved, or the band isn't left open: it may hold the mass, or a stop does.
[[nodiscard]] std::optional<BandEdge> creeps_to(const Scene& scene, double x, double v,
                                                const SineCosine<double>& phase);

/// The edge of that band, on a side, for a mass that comes from displacement x beyond it; nothing if it has none.
[[nodiscard]] std::optional<double> edge_of_band(const Scene& scene, Side side, double x);

/// The side of the band at whose edge a mass at x stands, to rounding; none if it stands elsewhere. A band of one place
/// has an upper edge alone.
[[nodiscard]] Side band_edge_at(const Scene& scene, double x);

}  // namespace scene
}  // namespace clatter
